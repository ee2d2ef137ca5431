#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Tests --reference with pictures whose errors decrease, and the error that it reports for itself.
# Usage: CLRT=path/to/clrt FORMATS="png, pfm" test_reference.sh SOURCE_FOLDER WORK_FOLDER
# shellcheck source=tests/cli/workplace.sh
. "$(dirname "$0")/workplace.sh"

# Evaluates an expression of the following reports, called r, s and t.
holds() {
  python3 - "$@" <<'END'
import json, sys
reports = [json.load(open(name))["reference"] for name in sys.argv[2:]]
sys.exit(not eval(sys.argv[1], dict(zip("rst", reports))))
END
}
same() { run 0 compare "$1" "$2" --fail max=0; }

scene="$source/scenes/reflections.scn"
small=(-s 96x72 -o a.pfm)
check "a picture is measured" run 0 "$scene" "${small[@]}" --reference=one.pfm --stats=one.json
check "... which is said" grep -q "^RMSE .* largest difference .* 1/255: .* 4/255: " err
check "... with the reference's samples and own error" grep -q "^reference: fp64, 256 samples a pixel, RMSE .* by itself" err
"$CLRT" "$scene" -s 96x72 -q -o plain.pfm
check "... and is the same picture" same a.pfm plain.pfm
run 0 compare a.pfm one.pfm --json
check "... whose error is the difference of the two files" python3 -c "
import json
r, d = json.load(open('one.json'))['reference'], json.load(open('out'))
assert abs(r['rmse'] - d['rmse']) < 1e-12 and abs(r['maximum'] - d['maximum']['value']) < 1e-12
assert r['share_off_by_1'] == d['off_by_1']['share'] and r['share_off_by_4'] == d['off_by_4']['share']"
check "more samples are measured too" run 0 "$scene" "${small[@]}" --aa=2 --reference=two.pfm --stats=two.json
check "... against the same reference" same one.pfm two.pfm
check "and more" run 0 "$scene" "${small[@]}" --aa=4 --reference --stats=four.json
check "the error falls as samples grow" holds "r['rmse'] > 1.8 * s['rmse'] > 3 * t['rmse'] > 0" one.json two.json four.json
check "the reference is better by itself" holds "t['own_error'] < 0.4 * t['rmse']" one.json two.json four.json
check "an adaptive picture is measured" run 0 "$scene" "${small[@]}" --error 0.5% --reference=five.pfm --stats=five.json
check "... and has the error that was asked for" holds "r['rmse'] < 0.0055" five.json
check "a finer reference is drawn" run 0 "$scene" "${small[@]}" --aa=4 --reference=fine.pfm --reference-samples 2048 --stats=fine.json
check "... of that many samples" holds "r['samples'] == 2048" fine.json
check "... that reports the same error" holds "abs(r['rmse'] / s['rmse'] - 1) < 0.08" fine.json four.json
check "... and less of its own" holds "r['own_error'] < 0.4 * s['own_error']" fine.json four.json
run 0 compare one.pfm fine.pfm --json=own.json
check "its reported own error is its true error" python3 -c "
import json
told, found = json.load(open('one.json'))['reference']['own_error'], json.load(open('own.json'))['rmse']
assert 0.6 < found / told < 1.6, (found, told)"
check "another grid of samples agrees" run 0 "$scene" -s 96x72 -q -o grid.pfm --aa=24 --precision fp64
check "... within what both are off by" run 0 compare grid.pfm fine.pfm --fail rmse=0.0006

check "adaptive pictures are measured" run 0 "$scene" "${small[@]}" --aa-adaptive=0.01 --reference=two.pfm --stats=adaptive.json
check "... against the same reference" same one.pfm two.pfm
check "... and are better than one sample" holds "r['rmse'] < 0.3 * s['rmse']" adaptive.json one.json

case $FORMATS in *exr*)
  colored="$source/tests/image/every_feature.scn"
  errors() {
    rate=$(python3 -c "import json; r = json.load(open('exr.json'))['reference']; print(r['maximum'], r['share_off_by_1'])")
    read -r most share <<<"$rate"
    "$here/read_exr.py" a.exr "types['error'] == 'float' and abs(max(c['error']) - $most) < 1e-7 and sum(e > 1 / 255 + 2 ** -22 for e in c['error']) / len(c['error']) == $share"
  }
  check "an EXR file has every pixel's error" run 0 "$colored" -s 96x72 -o a.exr --reference --stats=exr.json
  check "... as the statistics sum it up" errors
  check "--aov error asks for a reference" run 0 "$colored" -s 96x72 -o a.exr --aov error,depth --stats=exr.json
  check "... and has the same values" errors
  check "... behind other channels, too" run 0 "$colored" -s 96x72 -o a.exr --aov primitive,depth --reference --stats=exr.json
  check "... of the same values" errors
  check "... and leaves those alone" "$here/read_exr.py" a.exr "types['primitive'] == 'uint' and len(set(c['primitive'])) > 3 and max(c['error']) < 1" ;;
esac

check "bounces left out are an error" run 0 "$scene" "${small[@]}" --aa=4 --max-level 1 --reference --stats=level.json
check "... large enough to be seen" holds "r['rmse'] > 3 * s['rmse']" level.json four.json
check "a quiet run says nothing" run 0 "$scene" "${small[@]}" -q --reference --reference-samples 2
check "... at all" test ! -s err
check "without one the report has none" run 0 "$scene" "${small[@]}" -q --stats=none.json
check "... and says so" python3 -c "import json; assert json.load(open('none.json'))['reference'] is None"
check "the reference's file is checked before" run 5 "$scene" "${small[@]}" --reference=none/a.pfm
check "... and its ending" run 2 "$scene" "${small[@]}" --reference=a.nothing
check "two samples are the least" run 2 "$scene" "${small[@]}" --reference-samples 0

echo "$checks checks, $failures failures"
[ "$failures" = 0 ]
