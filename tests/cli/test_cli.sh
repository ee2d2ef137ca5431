#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Tests the command line: exit codes, messages, and an effect of every option. Usage:
# CLRT=path/to/clrt test_cli.sh SOURCE_FOLDER WORK_FOLDER
# shellcheck source=tests/cli/workplace.sh
. "$(dirname "$0")/workplace.sh"
scene=$source/scenes/reflections.scn

says() { grep -q -- "$1" err; }
pixels() { run 0 "$scene" -s 48x32 -o "$@"; }
differ() { ! cmp -s "$1" "$2"; }
json() { python3 -c "import json,sys; d=json.load(open('$1')); sys.exit(not ($2))"; }

check "no arguments explain the usage" refuses 2 "no scene is named; clrt --help shows the usage"
if [ "${WINDOW:-}" = ON ]; then
  no_window() {
    env -u WAYLAND_DISPLAY DISPLAY=:12345 "$CLRT" "$scene" >out 2>err
    [ $? = 2 ]
  }
  check "without a display there is no window" no_window
  check "... and it says so" says "^clrt: no window can be opened (.*): write the picture with -o FILE$"
  check "a format is for files" refuses 2 "--format is for files: give one with -o FILE" --format png "$scene"
  check "tiles are for files" refuses 2 "--tile is for files: give one with -o FILE" --tile 8x8 "$scene"
  check "adaptive samples are for files" \
    refuses 2 "--aa-adaptive is for files: give one with -o FILE" \
    --aa-adaptive "$scene"
  check "repeated pictures are for files" \
    refuses 2 "--repeat is for files: give one with -o FILE" --repeat 2 "$scene"
  check "channels are for files" \
    refuses 2 "--aov is for files: give one with -o FILE.exr" --aov depth "$scene"
  check "statistics in files are for files" \
    refuses 2 "--stats=FILE is for files: give one with -o FILE" --stats=a.json "$scene"
else
  check "without -o there is no window and it says so" \
    refuses 2 "this build has no window: write the picture with -o FILE" "$scene"
fi
check "keys are for the window" \
  refuses 2 "--keys and --quit-after are for the window: leave out -o" --keys q "$scene" -o a.pfm
check "frames to quit after are for the window" \
  refuses 2 "--keys and --quit-after are for the window: leave out -o" --quit-after 1 "$scene" -o a.pfm
check "frames to quit after are counted from 1" \
  refuses 2 "--quit-after wants an integer between 1 and 1000000, not '0'" --quit-after 0 "$scene"
check "an unknown option gets the nearest one" \
  refuses 2 "unknown option '--sise', perhaps --size" --sise 4x4 "$scene" -o a.pfm
check "an unknown letter is named" refuses 2 "unknown option '-z'; clrt --help lists them" -z
check "an option without its value is named" refuses 2 "--size wants a value" "$scene" --size
check "a value out of range is named" \
  refuses 2 "--size wants WIDTHxHEIGHT, each between 1 and 65536, not '0x5'" --size 0x5 "$scene"
check "two scenes are one too many" \
  refuses 2 "one scene at a time: 'b.scn' comes after 'a.scn' (values of --aa and --stats need an equals sign)" a.scn b.scn -o a.pfm
check "a value after a blank is explained" refuses 2 "one scene at a time: '4' comes after \
'a.scn' (values of --aa and --stats need an equals sign)" a.scn --aa 4 -o a.pfm
check "an unknown ending is refused before any work" \
  refuses 2 "a.xyz: the ending names no format; this build writes $FORMATS" \
  nowhere.scn -o a.xyz
check "a missing scene is exit 3" \
  refuses 3 "nowhere.scn: cannot be opened: No such file or directory" nowhere.scn -o a.pfm
check "a folder is no scene" refuses 3 "$source: cannot be read: it is not a file" "$source" -o a.pfm
echo 'spheer 0 0 0 1' >bad.scn
check "a fault in a scene is exit 3 with its place" \
  refuses 3 "bad.scn:1:1: unknown statement (did you mean 'sphere'?): found 'spheer'" bad.scn -o a.pfm
printf 'ply\nformat ascii 1.0\nelement vertex 2000000000\nproperty float x\n' >lie.ply
check "a lying mesh is exit 3" run 3 lie.ply -o a.pfm
check "a view that is not there is named" \
  refuses 3 "$scene has 6 viewpoints, so there is no view 7" "$scene" --view 7 -o a.pfm
check "a picture with the name of a folder is refused before any work" \
  refuses 5 "no/: cannot be written: it is a folder" nowhere.scn --format pfm -o no/
check "a folder that is not there is exit 5 before any work" \
  refuses 5 "no/a.pfm: cannot be written: No such file or directory" nowhere.scn -o no/a.pfm
check "a device that is not there is exit 4" run 4 "$scene" --device nosuchdevice -o a.pfm
check "... and says what there is" says "no device matches 'nosuchdevice'; there are:"
check "... by platform" says "Platform #0: "
OCL_ICD_VENDORS=/nonexistent check "a machine without OpenCL is exit 4" run 4 "$scene" -o a.pfm
check "... and says what to install" says "install pocl-opencl-icd"

check "help is printed on standard output" run 0 --help
check "... with every option" grep -q -- "--list-devices" out
[ "${WINDOW:-}" != ON ] || check "... and every key of the window" grep -q "^  q, Esc  quit$" out
check "the version is printed" run 0 --version
check "... as name and number" grep -Eqx "clrt [0-9]+\.[0-9]+\.[0-9]+" out
check "devices are listed" run 0 --list-devices
check "... as clinfo prints them" grep -q "^Platform #0: " out
device=$(sed -n 's/.*Device #0: //p' out | head -n 1)
check "a device is taken by its indices" pixels a.pfm --device 0:0
check "a device is taken by its type" pixels a.pfm --device cpu
check "a device is taken by part of its name" pixels a.pfm --device "${device:0:5}"

check "a picture is written" pixels plain.pfm -q
check "quiet says nothing" test ! -s err
check "it is written again" pixels again.pfm
check "two runs give identical files" cmp plain.pfm again.pfm
check "--view has an effect" pixels b.pfm --view 3
check "... on the picture" differ plain.pfm b.pfm
check "--aa has an effect" pixels b.pfm --aa
check "... on the picture" differ plain.pfm b.pfm
check "--aa=3 has another" pixels c.pfm --aa=3
check "... on the picture" differ c.pfm b.pfm
check "--aa-adaptive has an effect" pixels b.pfm --aa-adaptive
check "... on the picture" differ plain.pfm b.pfm
check "a lower contrast has another" pixels c.pfm --aa-adaptive=0.001 --stats=c.json
check "... on the picture" differ c.pfm b.pfm
check "... and counts its samples" json c.json \
  "d['samples']['total'] == d['rays']['camera'] > 1536 and d['samples']['contrast'] == 0.001"
check "... and per pixel" json c.json "d['samples']['per_pixel'] == d['samples']['total'] / 1536"
check "threads refine the same" pixels d.pfm --aa-adaptive=0.001 -j 1 --kernel ray --nodes pair
check "... picture" cmp c.pfm d.pfm
check "adaptive samples are no grid" refuses 2 \
  "--aa, --aa-adaptive, --error and --time each choose the samples: give one" --aa=3 --aa-adaptive "$scene" -o a.pfm
check "a contrast is a part of one" refuses 2 \
  "--aa-adaptive wants a number above 0 and up to 1, not '2'" --aa-adaptive=2 "$scene" -o a.pfm
check "an error is asked for" pixels b.pfm --error 0.5% --stats=b.json
check "... met within the estimate" json b.json \
  "d['samples']['goal_reached'] and 0 < d['samples']['error_estimate'] < d['samples']['error_bound'] <= 0.005"
check "... with the levels that it takes" json b.json "d['settings']['truncation_bound'] <= 0.00125"
check "... and is told" pixels b.pfm --error 0.005 --stats
check "... in percent" says "with 95 % confidence, of which at most 0.098 % for 5 levels$"
check "a smaller error takes more samples" pixels c.pfm --error 0.001 --stats=c.json
check "... says the JSON" json c.json \
  "d['samples']['total'] > 1600 and d['samples']['error_bound'] <= 0.001"
printf 'define it matte reflectivity 1\nmaterial it\nsphere 0 0 0 1\n' >mirror.scn
check "an error that no levels hold is exit 1" run 1 mirror.scn -s 8x8 --error 1% -o a.pfm
check "... and says so" says "clrt: the error may be 1e+02 %, more than --error allows"
check "an error is a number" refuses 2 \
  "--error wants a number above 0 and up to 1, or 100%, not 'low'" --error low "$scene" -o a.pfm
check "an error too small for the ladder is exit 1" run 1 "$scene" -s 48x32 --error 0.01% -o b.pfm --stats=b.json
check "... and says so" says "clrt: the error may be 0.0[0-9]* %, more than --error allows"
check "... in the statistics too" json b.json "not d['samples']['goal_reached'] and d['samples']['error_bound'] > 0.0001"
check "... and takes doubles" json b.json "d['settings']['precision'] == 'fp64'"
check "time is spent" pixels b.pfm --time 0.5 --stats=b.json
check "... on samples" json b.json "d['samples']['goal_reached'] and d['samples']['total'] > 10000"
check "... and no more" json b.json "d['seconds']['trace'] < 2"
check "too little time is exit 1" run 1 "$scene" --time 1e-9 -o a.pfm
check "... and says so" says "longer than --time allows$"
check "time is a number of seconds" refuses 2 \
  "--time wants seconds above 0 and up to 1000000, not '0'" --time 0 "$scene" -o a.pfm
check "--max-level has an effect" pixels b.pfm --max-level 1
check "... on the picture" differ plain.pfm b.pfm
check "--max-level auto finds the least that shows in no file of bytes" \
  run 0 "$scene" -s 48x32 -o a.ppm --format png --max-level auto --stats=a.json
check "... says the JSON" json a.json \
  "d['settings']['max_level'] == 5 and 0.25 ** 5 == d['settings']['truncation_bound'] < 1 / 510"
check "--max-level auto for floats" pixels a.pfm --max-level auto --stats=a.json
check "... takes more" json a.json \
  "d['settings']['max_level'] == 13 and 0.25 ** 13 == d['settings']['truncation_bound']"
check "... which more do not change" pixels b.pfm --max-level 40
check "... in the picture" cmp a.pfm b.pfm
check "a level is a number or auto" refuses 2 \
  "--max-level wants auto or an integer between 0 and 1000, not 'all'" --max-level all "$scene"
for same in "--no-bvh" "--bvh midpoint" "--bvh sah" "-j 1" "-j 2" "--tile 16x8" "--work-group 4x2" \
  "--specialize always" "--specialize never"; do
  # shellcheck disable=SC2086
  check "$same draws" pixels b.pfm $same
  check "$same draws the same picture" cmp plain.pfm b.pfm
done
CLRT_KERNEL_DIR=$source/kernels check "kernels are read from CLRT_KERNEL_DIR" pixels b.pfm
check "... and draw the same picture" cmp plain.pfm b.pfm
CLRT_KERNEL_DIR=/nonexistent check "missing kernels are exit 4" run 4 "$scene" -o b.pfm

check "statistics are printed" pixels a.pfm --stats
check "... with the course's figures" says "rays: 1536 camera,"
check "... and the samples of a pixel" says "^1536 samples, 1.00 per pixel$"
check "... and tests per ray" says "box tests, .* per ray"
check "statistics are written as JSON" pixels a.pfm --stats=a.json
check "... with camera rays" json a.json "d['rays']['camera'] == 1536"
check "... and a schema" json a.json "d['schema'] == 1"
check "... and every stage's time" json a.json \
  "sorted(d['seconds']) == sorted('parse load build device upload kernel_build trace write total'.split())"
check "--no-bvh tests no boxes" pixels a.pfm --no-bvh --stats=b.json
check "... says the JSON" json b.json "d['tests']['box'] == 0 and d['bvh']['builder'] == 'none'"
check "--bvh midpoint builds another tree" pixels a.pfm --bvh midpoint --stats=c.json
check "... says the JSON" json c.json "d['bvh']['builder'] == 'midpoint'"
"$CLRT" "$source/scenes/cube.ply" -s 16x16 -o b.pfm --kernel packet --bvh sah --stats=b.json
check "12 triangles are tested without a tree" run 0 "$source/scenes/cube.ply" -s 16x16 --kernel packet -o a.pfm --stats=a.json
check "... says the JSON" json a.json "d['tests']['box'] == 0 and d['bvh']['builder'] == 'none'"
check "... unless one is asked for" json b.json "d['bvh']['builder'] == 'sah'"
check "... which draws the same picture" cmp a.pfm b.pfm
check "-j 1 uses one compute unit" pixels a.pfm -v -j 1
check "... says -v" says ", 1 compute units"
check "tiles have an effect" pixels a.pfm --tile 16x8 --work-group 4x2 --stats=d.json
check "... says the JSON" json d.json "d['settings']['tile'] == [16, 8] and d['settings']['work_group'] == [4, 2]"
check "--specialize always has an effect" pixels a.pfm --specialize always --stats=e.json
check "... says the JSON" json e.json "d['settings']['specialized']"
check "--repeat draws the picture as often" pixels f.pfm --repeat 3 --stats=f.json
check "... and times each" json f.json "len(d['frame_seconds']) == 3 and min(d['frame_seconds']) > 0"
check "... the first as the picture's own" json f.json "d['seconds']['trace'] == d['frame_seconds'][0]"
check "... and writes the same picture" cmp a.pfm f.pfm
check "... and counts one" json f.json "d['rays']['camera'] == 1536"
check "JSON goes to standard output" pixels a.pfm --stats=-
check "... as JSON" json out "d['complete']"

check "--precision fp64 has an effect" pixels fp64.pfm --precision fp64 -v --stats=g.json
check "... on the picture" differ plain.pfm fp64.pfm
check "... traces rays one by one through pairs" says "kernels: ray, pair nodes, fp64"
check "... says the JSON" json g.json "(d['settings']['precision'], d['settings']['kernel'], \
d['settings']['nodes']) == ('fp64', 'ray', 'pair')"
for same in "--no-bvh" "--bvh midpoint" "-j 1" "--tile 16x8" "--work-group 4x2" "--specialize always" \
  "--kernel ray" "--nodes pair"; do
  # shellcheck disable=SC2086
  check "--precision fp64 $same draws" pixels b.pfm --precision fp64 $same
  check "--precision fp64 $same draws the same picture" cmp fp64.pfm b.pfm
done
check "--precision fp32 is what is drawn without it" pixels b.pfm --precision fp32 --stats=h.json
check "... to the bit" cmp plain.pfm b.pfm
check "... says the JSON" json h.json "d['settings']['precision'] == 'fp32'"
check "there is no other precision" \
  refuses 2 "--precision wants fp32 or fp64, not 'fp16'" --precision fp16 "$scene" -o b.pfm
check "packets have no fp64" \
  refuses 2 "--precision fp64 traces rays one by one: leave out --kernel packet" \
  --kernel packet --precision fp64 "$scene" -o b.pfm
check "wide nodes have no fp64" \
  refuses 2 "--precision fp64 uses binary nodes: leave out --nodes wide" \
  --precision fp64 --nodes wide "$scene" -o b.pfm
export ASAN_OPTIONS=verify_asan_link_order=0:${ASAN_OPTIONS:-}
LD_PRELOAD=$NO_FP64 check "a device without fp64 draws in fp32" run 0 "$scene" -s 48x32 -o b.pfm
LD_PRELOAD=$NO_FP64 check "... and is exit 4 in fp64" run 4 "$scene" --precision fp64 -s 8x8 -o b.pfm
check "... with the reason" says "has no double arithmetic, which --precision fp64 needs"
LD_PRELOAD=$NO_FP64 check "... clrt check too" run 4 check "$source/scenes/cube.ply" --precision fp64

mkdir -p readonly cold
HOME=/proc XDG_CACHE_HOME=/proc POCL_CACHE_DIR='' TMPDIR=$work/cold check "an unwritable HOME works" \
  env -u POCL_CACHE_DIR "$CLRT" "$scene" -s 8x8 -o a.pfm
check "... and its temporary cache is gone afterwards" test -z "$(ls cold)"

check "a reader that leaves early is exit 5" bash -c \
  "set -o pipefail; TMPDIR=$work/cold '$CLRT' '$scene' -s 800x800 -o - --format pfm 2>err | head -c 9 >out; \
  [ \${PIPESTATUS[0]} = 5 ]"
check "... with its reason" says "clrt: standard output: cannot be written: Broken pipe"
check "... and leaves nothing behind" test -z "$(ls cold)"
check "a mesh alone is a scene" run 0 "$source/scenes/cone.ply" -s 32x32 -o a.pfm
check "a pipe is a scene" bash -c "'$CLRT' <(cat '$source/scenes/simple.scn' | sed 's#ply_file #ply_file $source/scenes/#') -s 8x8 -o a.pfm"
check "PFM goes to standard output" run 0 "$scene" -s 8x8 -o - --format pfm
check "... as PFM" bash -c "head -c 2 out | grep -q PF"
"$CLRT" "$scene" -s 48x32 -o link.pfm 2>/dev/null
check "nothing unfinished is left beside pictures" test -z "$(find . -name '*.pfm.*')"

# Stops a long picture early. clrt must write the finished tiles. Background jobs of a shell may
# ignore SIGINT, so env restores its default. Busy machines need longer for the first tile, before
# which clrt writes nothing.
for moment in 1.5 5 20; do
  env --default-signal=INT "$CLRT" "$scene" -s 4000x4000 --aa=12 -o stopped.pfm --stats=stopped.json 2>err &
  sleep $moment
  kill -INT $!
  wait $!
  code=$?
  says "before the first tile" || break
done
check "Ctrl-C exits with 130" test $code = 130
check "... and writes what is done" test -s stopped.pfm
check "... marked as incomplete" json stopped.json "not d['complete']"

# After --warm, a second run reports the first kernels as already compiled.
rm -rf warm-cache
warm() { env -u POCL_CACHE_DIR XDG_CACHE_HOME="$work/warm-cache" "$CLRT" --warm --kernel ray "$@" >out 2>err; }
check "--warm compiles ahead" warm
check "... and says so" grep -q "^general kernels, ray, .* nodes, fp32: compiled in" out
check "... those for a scene too" warm "$scene" --stats
check "... and says so" grep -q "^special kernels, ray, .* nodes, fp32: compiled in" out
check "... and those of fp64" warm --precision fp64
check "... and says so" grep -q "^general kernels, ray, pair nodes, fp64: compiled in" out
check "... but nothing twice" warm
check "... and says so" grep -q "^general kernels, ray, .* nodes, fp32: were compiled, ready in" out
check "a scene then finds its own compiled" env -u POCL_CACHE_DIR XDG_CACHE_HOME="$work/warm-cache" "$CLRT" \
  --kernel ray "$scene" -s 48x32 -o warm.pfm --stats=warm.json
check "... and takes it" json warm.json "d['settings']['specialized']"
check "--warm reports a missing scene" run 3 --warm missing.scn
check "--warm with a device that is not there" run 4 --warm --device 9:9

# Twelve concurrent cold starts share a cache.
rm -rf cold-cache
for i in 1 2 3 4 5 6 7 8 9 10 11 12; do
  env -u POCL_CACHE_DIR XDG_CACHE_HOME="$work/cold-cache" "$CLRT" "$scene" -s 48x32 -o "cold$i.pfm" 2>"err$i" &
done
wait
for i in 1 2 3 4 5 6 7 8 9 10 11 12; do
  cp "err$i" err
  check "cold start $i of twelve at once succeeds" cmp plain.pfm "cold$i.pfm"
done

# While packet kernels are not compiled, clrt draws small pictures with kernels that compile faster.
sooner() { run 0 "$scene" -s 48x32 -o soon.pfm -v "$@"; }
drew() { grep -q "^kernels: $1, $2 nodes" err; }
export_cache() { rm -rf "$1" && export XDG_CACHE_HOME=$work/$1 POCL_CACHE_DIR=$work/$1/pocl; }
caches=("$XDG_CACHE_HOME" "$POCL_CACHE_DIR")
export_cache sooner-cache
check "a small picture is drawn cold" sooner
check "... by single rays and pairs" drew ray pair
check "... as ever" cmp plain.pfm soon.pfm
for asked in "--lanes 4" --stats; do
  export_cache asked-cache
  # shellcheck disable=SC2086
  check "a small picture is drawn cold with $asked" sooner $asked
  check "... by packets" drew packet wide
done
export_cache sooner-cache
check "a large picture is drawn cold" run 0 "$scene" -s 1300x1300 -j 1 -o large.pfm -v
check "... by packets" drew packet wide
check "a small one after it" sooner
check "... by packets too" drew packet wide
export_cache sooner-cache
check "small pictures are drawn" sooner
check "... and no run changes the kernels of the next" sooner
check "... which are single rays still" drew ray pair
export_cache sooner-cache
check "packets are compiled ahead" run 0 --warm
check "... and a small picture drawn" sooner
check "... by packets" drew packet wide
export XDG_CACHE_HOME=${caches[0]} POCL_CACHE_DIR=${caches[1]}

check "PNG is written" pixels a.png
cp a.png b.png
check "PNG is written again" pixels a.png
check "two PNGs are identical" cmp a.png b.png
is_png_of() { "$source/tests/cli/check_png.py" "$@" 2>err; }
check "PNG holds the picture and its texts" is_png_of a.png plain.pfm
check "--encode srgb has an effect" pixels b.png --encode srgb
check "... on PNG, as the curve has it" is_png_of b.png plain.pfm srgb
check "a PNG of one pixel is written" run 0 "$scene" -s 1x1 -o one.png
check "... and its PFM" run 0 "$scene" -s 1x1 -o one.pfm
check "... the same" is_png_of one.png one.pfm
check "a PNG of many chunks is written" run 0 "$scene" -s 801x603 --aa -o many.png
check "... as many as it takes" test "$(grep -ao IDAT many.png | wc -l)" -gt 1
check "... and its PFM" run 0 "$scene" -s 801x603 --aa -o many.pfm
check "... the same" is_png_of many.png many.pfm
check "PNG goes to standard output" run 0 "$scene" -s 48x32 -o -
check "... the same as to a file" cmp out a.png
check "--format overrides the extension" pixels odd.bin --format png
check "... as the same PNG" cmp odd.bin a.png
# The scene is a pipe, which clrt opens after it has checked the folder.
mkdir gone
mkfifo late.scn
check "a folder that vanishes is exit 5" bash -c "'$CLRT' late.scn -s 8x8 -o gone/a.png 2>err & \
  exec 3>late.scn; rmdir gone; echo sphere 0 0 0 1 >&3; exec 3>&-; wait \$!; [ \$? = 5 ]"
check "... with the reason" says "clrt: gone/a.png: cannot be written"
check "/dev/null takes a picture" run 0 "$scene" -s 8x8 -o /dev/null --format png
for format in png pfm; do
  check "/dev/full takes no $format" refuses 5 \
    "/dev/full: cannot be written: No space left on device" "$scene" -s 8x8 -o /dev/full --format $format
done

if [ "${FORMATS:-}" != "png, pfm" ]; then
  for format in jpg tif ppm exr hdr; do
    check "$format is written" pixels "a.$format"
    cp "a.$format" "b.$format"
    sleep 0.01
    check "$format is written again" pixels "a.$format"
    check "two $format files are identical" cmp "a.$format" "b.$format"
  done
  check "a picture too large for the process beside is written" \
    run 0 "$source/scenes/simple.scn" -s 2400x2400 -o large.tif --format hdr
  check "... whole" test "$(head -c 400 large.tif | grep -ac -- '-Y 2400 +X 2400')" = 1
  check "--encode srgb leaves floats alone" pixels b.exr --encode srgb
  check "a JPEG past its size is refused" refuses 5 "a JPEG has at most 65500 pixels a side" \
    "$scene" -s 65536x1 -o a.jpg
  check "EXR holds metadata" grep -aq "clrt:settings" a.exr
  check "... with the precision" grep -aq '"precision":"fp32"' a.exr
  check "... fp64's too" pixels b.exr --precision fp64
  check "... with the precision" grep -aq '"precision":"fp64"' b.exr
  exr() { "$here/read_exr.py" "$@" 2>>err; }
  check "EXR takes channels" pixels c.exr --aa --bvh sah --aov depth,normal,position,primitive,material,shadow,bounces,samples,boxtests,tritests
  check "... named by the field's conventions" exr c.exr "sorted(types) == sorted('R G B Z N.X N.Y N.Z P.X P.Y P.Z primitive material shadow bounces samples boxtests tritests'.split())"
  check "... of which names of things are integers" exr c.exr "{t for t in types if types[t] == 'uint'} == {'primitive', 'material'}"
  check "... beside the same colors" pixels b.exr --aa --bvh sah
  check "... bit for bit" python3 -c "import sys; sys.path.insert(0, '$here'); from read_exr import read_exr as r; a, b = r('b.exr')[1], r('c.exr')[1]; sys.exit(any(a[n] != b[n] for n in 'RGB'))"
  check "the background is infinitely far" exr c.exr "c['Z'][0] == inf and c['primitive'][0] == c['material'][0] == 2**32 - 1"
  check "... and zero else" exr c.exr "all(c[n][0] == 0 for n in 'N.X N.Y N.Z P.X P.Y P.Z shadow bounces'.split())"
  check "every channel has an effect" exr c.exr "all(len(set(v)) > 1 for n, v in c.items() if n != 'samples')"
  check "samples are those of --aa" exr c.exr "set(c['samples']) == {4}"
  check "adaptive samples are counted where they are" pixels g.exr --aa-adaptive --aov samples --stats=g.json
  check "... pixel by pixel" exr g.exr "set(c['samples']) >= {1, 9} and sum(c['samples']) == __import__('json').load(open('g.json'))['samples']['total']"
  check "tests are not counted with them" refuses 2 "--aov boxtests and tritests count a grid of samples: leave out --aa-adaptive, --error and --time" "$scene" -o a.exr --aa-adaptive --aov tritests
  check "channels are one sample's, whatever --aa" pixels d.exr --aov depth,primitive,normal
  check "... bit for bit" python3 -c "import sys; sys.path.insert(0, '$here'); from read_exr import read_exr as r; a, b = r('d.exr')[1], r('c.exr')[1]; sys.exit(any(a[n] != b[n] for n in ['Z', 'primitive', 'N.X']))"
  for change in "-j 1" "--tile 16x8" "--kernel packet" "--kernel ray --nodes wide"; do
    # shellcheck disable=SC2086
    check "channels with $change" pixels e.exr --aa --nodes wide $change --aov normal,position,bounces,tritests
    [ -e f.exr ] || cp e.exr f.exr
    check "... are the same" cmp e.exr f.exr
  done
  check "a large picture with channels goes past the process beside" \
    run 0 "$source/scenes/simple.scn" -s 1600x1600 -o large.exr --aov primitive,normal,position
  check "... whole" exr large.exr "len(set(c['primitive'])) > 1 and len(c['P.Z']) % 1600 == 0" 1590
  check "channels are for EXR" refuses 2 "--aov needs an EXR file (-o FILE.exr): png holds colors alone" "$scene" -o a.png --aov depth
  check "/dev/full takes no picture of OpenImageIO's either" run 5 "$scene" -s 8x8 -o /dev/full --format ppm
fi

echo "$checks checks, $failures failures"
[ "$failures" = 0 ]
