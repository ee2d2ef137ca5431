#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Tests clrt compare: all formats, text, JSON, the map, limits, exit codes, and hostile files.
# Usage: CLRT=path/to/clrt FORMATS="png, pfm" test_compare.sh SOURCE_FOLDER WORK_FOLDER
# shellcheck source=tests/cli/workplace.sh
. "$(dirname "$0")/workplace.sh"

tells() { grep -qF -- "$1" out; }
json() { python3 -c "import json,sys; d=json.load(open('$1')); sys.exit(not ($2))"; }

# Writes a PFM file of one row. The arguments are its name, green and blue of all pixels, and red of
# each pixel.
row() {
  python3 - "$@" <<'END'
import struct, sys
other, *reds = [float(word) for word in sys.argv[2:]]
with open(sys.argv[1], "wb") as file:
    file.write(b"PF\n%d 1\n-1.0\n" % len(reds))
    for red in reds:
        file.write(struct.pack("<3f", red, other, other))
END
}

row a.pfm 0.5 0 0 0 0
row b.pfm 0.5 0 0.25 0 0.0078125
row expected.pfm 0 0 0.25 0 0.0078125
row brightness.pfm 0 0 0.99805 0 0.17643
row long.pfm 0.5 0 0 0 0 0
row nan.pfm 0.5 0 0 nan 0
row inf.pfm 0.5 0 inf 0 0

check "a picture equals itself" run 0 compare a.pfm a.pfm
check "... which is said" tells "all colors are equal"
check "two pictures differ" run 0 compare a.pfm b.pfm
check "... by their RMSE in parts of one and percent" tells "RMSE 0.072204 (7.22 %), PSNR 22.83 dB"
check "... by their largest difference and where it is" tells "largest difference 0.25, in red at 1,0"
check "... in pixels off by more than 1/255" tells "off by more than 1/255: 2 pixels (50 %)"
check "... and by more than 4/255" tells "off by more than 4/255: 1 pixels (25 %)"
check "... without a word on first hits" test "$(wc -l <out)" = 5
check "quiet says nothing" run 0 compare -q a.pfm b.pfm
check "... at all" test ! -s out
check "JSON goes to standard output" run 0 compare a.pfm b.pfm --json
check "... with every figure" json out "d['schema'] == 1 and abs(d['rmse'] ** 2 - (0.25 ** 2 + 2 ** -14) / 12) < 1e-15 and d['maximum'] == {'value': 0.25, 'x': 1, 'y': 0, 'color': 0}"
check "... counts and shares" json out "d['off_by_1'] == {'pixels': 2, 'share': 0.5} and d['off_by_4'] == {'pixels': 1, 'share': 0.25} and d['wrong_hits'] is None"
check "JSON goes to a file beside the text" run 0 compare a.pfm a.pfm --json=same.json
check "... with no ratio for equal pictures" json same.json "d['psnr'] is None and d['rmse'] == 0 and d['files'] == ['a.pfm', 'a.pfm']"
check "... beside the text" tells "all colors are equal"

check "kept limits are exit 0" run 0 compare a.pfm b.pfm --fail rmse=0.1,max=0.25,psnr=20,share1=50%,share4=0.25
check "... and told" tells "kept: share1 0.5, the limit is 0.5"
for limit in rmse=7% max=0.24 psnr=23 share1=0.49 share4=24%; do
  check "the limit $limit is broken: exit 1" run 1 compare a.pfm b.pfm --fail "$limit" --json=limit.json
  check "... and told" tells "BROKEN: ${limit%=*} "
  check "... in JSON too" json limit.json "d['kept'] is False and d['limits']['${limit%=*}']['kept'] is False"
done
check "a limit on hits wants first hits" refuses 3 \
  "a.pfm and b.pfm do not both have a channel 'primitive', so that a limit on hits cannot be judged" compare a.pfm b.pfm --fail hits=0

check "the map is a picture" run 0 compare a.pfm b.pfm -o map.png
check "... whose brightness is the root of the difference, full from 64/255 on" \
  run 0 compare map.png brightness.pfm --fail max=0.002
check "a map of floats holds the differences" run 0 compare a.pfm b.pfm -o map.pfm -q
check "... and nothing else" cmp map.pfm expected.pfm
check "a map may go to standard output" run 0 compare -q a.pfm b.pfm -o - --format pfm
check "... alone" cmp out expected.pfm

check "one picture is usage" refuses 2 "clrt compare wants the names of two pictures" compare a.pfm
check "three are, too" refuses 2 "clrt compare wants the names of two pictures" compare a.pfm b.pfm a.pfm
check "clrt compare rejects options of pictures" refuses 2 "clrt compare takes no --aa" compare a.pfm b.pfm --aa
check "--fail is for compare" refuses 2 "--fail is for clrt compare" "$source/scenes/simple.scn" -o a.png --fail rmse=1
check "limits are checked" refuses 2 \
  "--fail needs limits like rmse=0.01,max=0.1,psnr=40,share1=1%,share4=0,hits=0, not 'mse=1'" compare a.pfm b.pfm --fail mse=1
check "map and report share no stream" refuses 2 \
  "the picture and the report cannot both go to standard output" compare a.pfm b.pfm -o -
check "other sizes are exit 3" refuses 3 "a.pfm has 4 x 1 pixels and long.pfm has 5 x 1" compare a.pfm long.pfm
check "no file is exit 3" refuses 3 "none.pfm: cannot be read: No such file or directory" compare a.pfm none.pfm
check "a folder is exit 3" refuses 3 ".: cannot be read: Is a directory" compare a.pfm .
mkfifo pipe
check "a pipe is exit 3, and nobody waits for it" refuses 3 "pipe: cannot be read: it is not a file" compare a.pfm pipe
check "NaN is exit 3" refuses 3 "nan.pfm: R of pixel 2,0 is not finite" compare a.pfm nan.pfm
check "so is infinity" refuses 3 "inf.pfm: R of pixel 1,0 is not finite" compare inf.pfm a.pfm
check "a map that cannot be written is exit 5" run 5 compare a.pfm b.pfm -o none/map.png
check "a full disk is exit 5" run 5 compare a.pfm b.pfm --json=/dev/full

# clrt recognizes every format that it writes by the first bytes. JPEG and HDR are inexact.
scene="$source/tests/image/every_feature.scn"
"$CLRT" "$scene" -s 64x48 -q -o one.pfm
for format in ${FORMATS//,/}; do
  "$CLRT" "$scene" -s 64x48 -q -o "one.$format" && "$CLRT" "$scene" -s 64x48 -q --aa -o "two.$format"
  case $format in jpg) most=rmse=0.03 ;; hdr) most=max=0.01 ;; exr | pfm) most=max=0 ;; *) most=max=0.00197 ;; esac
  cp "one.$format" nameless
  check "$format is read" run 0 compare one.pfm nameless --fail "$most"
  check "... and differs from another" run 1 compare "one.$format" "two.$format" --fail rmse=0.01
  check "... with the map of its kind" run 0 compare "one.$format" "two.$format" -o "map.$format"
done

# Colors in 32-bit integers are fractions of the largest integer. Integers in other channels are
# numbers.
case $FORMATS in *tif*)
  python3 - <<'END'
import struct
tags = [(256, 3, 1, 1), (257, 3, 1, 1), (258, 3, 3, 122), (259, 3, 1, 1), (262, 3, 1, 2),
        (273, 4, 1, 128), (277, 3, 1, 3), (278, 3, 1, 1), (279, 4, 1, 12)]
data = b"II*\0" + struct.pack("<IH", 8, len(tags)) + b"".join(struct.pack("<HHII", *tag) for tag in tags)
data += bytes(4) + struct.pack("<3H3I", 32, 32, 32, 2**32 - 1, 2**31, 0)
open("wide.tif", "wb").write(data)
open("colors.pfm", "wb").write(b"PF\n1 1\n-1.0\n" + struct.pack("<3f", 1, 0.5, 0))
END
  check "colors of 32 bits are read" run 0 compare wide.tif colors.pfm --fail max=1e-6 ;;
esac

# Tests causes from the channels of --aov: a moved light, moved spheres, a level limit, and other
# samples.
case $FORMATS in *exr*)
  sed "s|^ply_file |ply_file $source/scenes/|" "$source/scenes/reflections.scn" >scene.scn
  awk '$1 == "light" { $2 += 0.7 } { print }' scene.scn >light.scn
  sed -E 's/^sphere [^ ]+/sphere 0.2/' scene.scn >moved.scn
  channels=(-s 160x120 -q --aov primitive,shadow,bounces)
  "$CLRT" scene.scn "${channels[@]}" -o plain.exr
  "$CLRT" light.scn "${channels[@]}" -o light.exr
  "$CLRT" moved.scn "${channels[@]}" -o moved.exr
  "$CLRT" scene.scn "${channels[@]}" --max-level 2 -o level.exr
  "$CLRT" scene.scn "${channels[@]}" --aa -o aa.exr
  "$CLRT" scene.scn "${channels[@]}" --precision fp64 -o fp64.exr
  sums="abs(sum(c['mean_square'] for c in d['causes'].values()) - d['rmse'] ** 2) < 0.01 * d['rmse'] ** 2"
  causes() {
    check "$1: causes are found" run 0 compare plain.exr "$1.exr" --json
    check "... and sum to the whole" json out "$sums"
    check "... with the right one first" json out "$2"
  }
  causes light "d['causes']['shadow']['share'] > 0.5 and d['wrong_hits']['pixels'] == 0"
  causes moved "d['causes']['primitive']['share'] > 0.3 and d['causes']['reflection']['pixels'] > 0 and d['wrong_hits']['pixels'] > 100"
  causes level "d['causes']['truncation']['share'] == 1"
  causes aa "d['causes']['coverage']['share'] > 0.99"
  causes fp64 "d['causes']['rounding']['share'] == 1"
  check "a limit on hits is judged" run 1 compare plain.exr moved.exr --fail hits=0
  check "... and reports the causes" tells "another primitive is hit first"
  check "... and kept where the hits are the same" run 0 compare plain.exr aa.exr --fail hits=0 ;;
esac

# For truncated files, changed bytes and absurd sizes, clrt must print one message and exit with 3,
# or read a picture.
survives() { "$CLRT" compare -q "$1" "$1" >out 2>err; case $? in 0 | 3) ! grep -q 'clrt: .*clrt:' err ;; *) false ;; esac; }
for format in ${FORMATS//,/}; do
  head -c 40 "one.$format" >short
  check "$format cut short is refused" run 3 compare short short
  check "... in one sentence" test "$(wc -l <err)" = 1
done
cat >spoil.py <<'END'
import random, sys
data = bytearray(open(sys.argv[1], "rb").read())
random.seed(int(sys.argv[2]))
for _ in range(8):
    data[random.randrange(4, min(len(data), 600))] = random.randrange(256)
open("spoiled", "wb").write(data)
END
for format in ${FORMATS//,/}; do
  for seed in 1 2 3; do
    python3 spoil.py "one.$format" "$seed"
    check "$format, spoiled $seed, harms nobody" survives spoiled
  done
done
printf 'PF\n65536 65536\n-1.0\n' >vast
check "a vast PFM is refused before it is read" refuses 3 \
  "vast: cannot be read: 65536 x 65536 pixels of 3 channels are too many" compare vast vast
printf 'PF\n60000 5000\n-1.0\n' >hollow
check "a hollow one ends early" refuses 3 "hollow: cannot be read: it ends early" compare hollow hollow
case $FORMATS in *ppm*)
  printf 'P6\n65535 65535\n255\n' >vast.ppm
  check "a vast PPM is refused" refuses 3 "vast.ppm: cannot be read: it is too large" compare vast.ppm vast.ppm ;;
esac
printf 'GIF89a\1\0\1\0' >a.gif
check "clrt rejects other formats" run 3 compare a.gif a.gif
check "... with the names of those that are not" grep -q "a.gif: cannot be read: it is no PNG" err

echo "$checks checks, $failures failures"
[ "$failures" = 0 ]
