#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Tests clrt --explain-pixel: text, JSON, the picture's color and messages. Usage: CLRT=path/to/clrt
# test_explain.sh SOURCE_FOLDER WORK_FOLDER
# shellcheck source=tests/cli/workplace.sh
. "$(dirname "$0")/workplace.sh"
scene=$source/tests/image/every_feature.scn

# tests/image/test_explain_by_hand.c computes these numbers by hand.
cat >mirrors.scn <<'END'
size 5 5
ambient 0.1
background 0 0 1
light 0 0 2 1
define mirror matte diffuse 1 1 1 kd 0.5 reflectivity 0.5
material mirror
sphere 0 3 0 1
sphere 0 -3 0 1
camera 0 0 0 0 1 0 90
END

json() { python3 -c "import json,sys; d=json.load(open('$1')); sys.exit(not ($2))"; }
tells() { grep -qF -- "$1" out; }

# The reported color of pixel 70,60 must be the picture's with the same options.
agrees() {
  run 0 "$scene" --explain-pixel 70,60 --json=explained.json "$@" &&
    run 0 "$scene" -o a.pfm "$@" && python3 - <<'END'
import json, struct, sys
data = open("a.pfm", "rb").read()
_, size, _, pixels = data.split(b"\n", 3)
width, height = map(int, size.split())
place = ((height - 1 - 60) * width + 70) * 12
sys.exit(list(struct.unpack("<3f", pixels[place : place + 12])) != json.load(open("explained.json"))["color"])
END
}

check "a pixel is explained" run 0 mirrors.scn --explain-pixel 2,2
check "... on standard output alone" test ! -s err
check "... the picture first" test "$(head -n 1 out)" = "pixel 2,2 of 5 x 5, view 1 of mirrors.scn"
check "... what a ray meets" test "$(grep -c "meets      sphere 1, material mirror" out)" = 2
check "... what a light does" tells "light 1    reaches it from 2.82843 away; cosine 0.707107; diffuse 0.353553"
check "... what is reflected" tells "reflected ray 2, weight 0.25 in the sample"
check "... the background's part" tells "the background (0, 0, 1), weight 0.125 in the sample"
check "... and the color" test "$(tail -n 1 out)" = "the pixel's color (0.396859199, 0.396859199, 0.521859169), in 8 bits 101 101 133"
check "docs/explaining.md shows the same" python3 -c "import sys; sys.exit(open('out').read() not in open('$source/docs/explaining.md').read())"
check "a corner sees the background" run 0 mirrors.scn --explain-pixel 0,4
check "... and says so" tells "meets      nothing"
check "JSON is written to standard output" run 0 mirrors.scn --explain-pixel 2,2 --json
check "... whole" json out "d['schema'] == 1 and d['pixel'] == [2, 2] and d['size'] == [5, 5] and len(d['samples']) == 1"
check "... with each ray" json out "[r['hit']['primitive']['number'] for r in d['samples'][0]['rays']] == [1, 2, 1]"
check "... with weights" json out "[r['weight'] for r in d['samples'][0]['rays']] == [1, 0.5, 0.25]"
check "... and kinds" json out "[r['kind'] for r in d['samples'][0]['rays']] == ['camera', 'reflected', 'reflected']"
check "a blocker is named" run 0 "$scene" --explain-pixel 70,60 --json
check "... with its kind and file" json out "all(b is None or b['kind'] == 'sphere' or b['file'].endswith('.ply') for s in d['samples'] for r in s['rays'] if r['hit'] for l in r['hit']['lights'] for b in [l['blocker']])"

# The first light is behind the face only, the second light is also behind the normal.
cat >leaning.ply <<'END'
ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
property float nx
property float ny
property float nz
element face 1
property list uchar int vertex_indices
end_header
-10 -10 0 0.6 0 0.8
10 -10 0 0.6 0 0.8
10 10 0 0.6 0 0.8
3 0 1 2
END
cat >leaning.scn <<'END'
size 5 5
light 11 -2 -5 1
light -9 -2 -5 1
material 1
ply_file leaning.ply
up 0 1 0
camera 1 -2 4 1 -2 0 90
END
check "lights behind a surface are explained" run 0 leaning.scn --explain-pixel 2,2
check "... by its face" tells "light 1    does not reach it: the face is turned away; cosine 0.1788"
check "... by its normal" tells "light 2    does not reach it: the normal is turned away; cosine -0.8944"
check "lights behind a surface as JSON" run 0 leaning.scn --explain-pixel 2,2 --json
check "... have both reasons" json out "[l['state'] for l in d['samples'][0]['rays'][0]['hit']['lights']] == ['behind_face', 'behind']"
for form in "" "--aa=3" "--kernel ray --nodes pair" "--kernel ray --nodes wide" "--kernel packet --lanes 4" \
  "--precision fp64" "--precision fp64 --aa" "--no-bvh" "--max-level 1" "--max-level 0" "-j 1"; do
  # shellcheck disable=SC2086
  check "the color is the picture's${form:+ with }$form" agrees $form
done
check "--encode srgb has an effect" run 0 mirrors.scn --explain-pixel 2,2 --encode srgb
check "... on the bytes" test "$(tail -n 1 out)" = "the pixel's color (0.396859199, 0.396859199, 0.521859169), in 8 bits 169 169 191"

# Specialized kernels omit features that a scene lacks; general ones contain them unused.
printf 'size 8 8\nlight 0 0 9 1\nmaterial 1\nsphere 0 0 0 1\n' >ball.scn
printf 'size 8 8\nmaterial 0\nply_file %s/scenes/cube.ply\n' "$source" >flat.scn
part() { json explained.json "[p[k] for p in d['parts'] if p['name'] == '$1' for k in ('needed', 'compiled', 'reason')] == [$2, $3, '$4']"; }
check "a scene is explained" run 0 ball.scn --explain --specialize always
check "... with what is compiled" tells "  spheres     1 of them"
check "... and what is left out" tells "  tree        there are no triangles to find"
check "... with the reason" tells "  triangles   there are none"
check "... under its heading" test "$(sed -n '/^left out$/,/^uploaded/p' out | grep -c '^  ')" = 4
check "... and what is uploaded" tells "  spheres     48 bytes"
check "... and what is not" tells " nodes triangles looks normals"
check "special kernels as JSON" run 0 ball.scn --explain --specialize always --json=explained.json
check "... have what the scene has" part spheres True True "1 of them"
check "... not what it lacks" part triangles False False "there are none"
check "... and no mirrors" part mirrors False False "no material in use reflects: no ray is followed on"
check "... and say why they are" json explained.json "d['program'] == {'special': True, 'reason': '--specialize always'}"
check "general kernels" run 0 ball.scn --explain --specialize never --json=explained.json
check "... hold all but counters" part triangles False True "there are none"
check "... which are asked for" part statistics False False "not requested: no --stats"
check "counters" run 0 ball.scn --explain --specialize never --stats --json=explained.json
check "... are compiled where they are" part statistics True True "--stats counts rays and tests"
check "silhouettes" run 0 flat.scn --explain --specialize always --json=explained.json
check "... are not lit" part lights False False "all materials in use are silhouettes: no shadow rays"
check "... and few triangles get no tree" part tree False False "10 triangles are tested sooner than found"
check "a tree that is asked for" run 0 flat.scn --explain --bvh sah --kernel ray --nodes pair --json=explained.json
check "... is there" json explained.json "next(p for p in d['parts'] if p['name'] == 'tree')['needed'] and d['uploaded_bytes']['nodes'] > 0"
check "... with the kernels asked for" json explained.json "d['kernels'] == {'family': 'ray', 'nodes': 'pair', 'precision': 'fp32', 'reason': '--kernel requests it'}"
check "explaining draws nothing" refuses 2 "clrt --explain takes no --output" ball.scn --explain -o a.pfm

check "a pixel outside is named" refuses 2 \
  "--explain-pixel 2,9: the picture has 5 x 5 pixels, counted from 0" mirrors.scn --explain-pixel 2,9
check "half a pixel is refused" refuses 2 "--explain-pixel wants X,Y counted from 0, X from the left and \
Y from the top, not '2'" mirrors.scn --explain-pixel 2
check "nothing is drawn beside" refuses 2 "clrt --explain-pixel takes no --output" \
  mirrors.scn --explain-pixel 2,2 -o a.pfm
check "a missing scene is exit 3" \
  refuses 3 "nowhere.scn: cannot be opened: No such file or directory" nowhere.scn --explain-pixel 0,0
check "a full disk is exit 5" run 5 mirrors.scn --explain-pixel 2,2 --json=/dev/full

echo "$checks checks, $failures failures"
[ "$failures" = 0 ]
