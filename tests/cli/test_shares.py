#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests --part auto/N and --frames auto/N with the variables of job arrays and of MPI.
# Usage: test_shares.py CLRT FORMATS
from work import SCENE, Work, main

SMALL = [SCENE, "-s", "32x24"]
FROM_ZERO = ["AWS_BATCH_JOB_ARRAY_INDEX", "JOB_COMPLETION_INDEX", "OMPI_COMM_WORLD_RANK", "PMI_RANK", "SLURM_PROCID"]
NAMES = ["SLURM_ARRAY_TASK_ID", *FROM_ZERO]
UNSET = dict.fromkeys(NAMES)
# The variables that each scheduler sets for one of three tasks, and this task's number from 1 to 3.
TASKS = [
    ({"SLURM_ARRAY_TASK_ID": "2", "SLURM_ARRAY_TASK_COUNT": "1", "SLURM_PROCID": "0"}, 2),
    ({"AWS_BATCH_JOB_ARRAY_INDEX": "2", "AWS_BATCH_JOB_ID": "6c7a:2"}, 3),
    ({"JOB_COMPLETION_INDEX": "0", "HOSTNAME": "clrt-0-x7k2p", "KUBERNETES_SERVICE_HOST": "10.0.0.1"}, 1),
    ({"OMPI_COMM_WORLD_RANK": "1", "OMPI_COMM_WORLD_SIZE": "3"}, 2),
    ({"PMI_RANK": "2", "PMI_SIZE": "3"}, 3),
    ({"SLURM_PROCID": "1", "SLURM_NTASKS": "3"}, 2),
]


class Shares(Work):
    def frames(self, *words, **environment):
        """Returns the numbers of the pictures that clrt draws."""
        for path in self.work.glob("f.*"):
            path.unlink()
        self.clrt(*SMALL, *words, "-o", "f.pfm", "-q", **UNSET | environment)
        return [int(path.name[2:6]) for path in sorted(self.work.glob("f.*"))]

    def test_the_task_s_number_chooses_the_frames(self):
        for environment, task in TASKS:
            drawn = self.frames("--turntable", "7", "--frames", "auto/3", **environment)
            self.assertEqual(drawn, [[1, 2], [3, 4], [5, 6, 7]][task - 1], environment)

    def test_the_first_variable_wins(self):
        numbers = ["3", *"34567"]
        for first in range(len(NAMES)):
            drawn = self.frames("--turntable", "9", "--frames", "auto/9", **dict(zip(NAMES[first:], numbers[first:])))
            self.assertEqual(drawn, [int(numbers[first]) + (first > 0)], NAMES[first])

    def test_shares_cover_any_range_once(self):
        for words, of in ((["--frames", "2-6:2,{}/2"], 2), (["--frames", "1-6,{}/4"], 4),
                          (["--turntable", "11", "--frames", "{}/3"], 3),
                          (["--turntable", "99", "--frames", "5-99:10,{}/5"], 5)):
            whole = [word.replace(f",{{}}/{of}", "").replace(f"{{}}/{of}", "1/1") for word in words]
            drawn = [self.frames(*(word.format(share) for word in words)) for share in range(1, of + 1)]
            self.assertEqual(sum(drawn, []), self.frames(*whole), words)
            self.assertLessEqual(max(map(len, drawn)) - min(map(len, drawn)), 1)

    def test_wrong_task_numbers_are_refused(self):
        for option, words in ("part", ["-o", "a.exr"]), ("frames", ["--turntable", "9", "-o", "a.pfm"]):
            for name, wrong, numbers in (("SLURM_ARRAY_TASK_ID", ["0", "9", "", "x", "-1"], "1 to 8"),
                                         *((name, ["8", "-1", "1.5", "99999999999999999999"], "0 to 7")
                                           for name in FROM_ZERO)):
                for value in wrong:
                    self.refuses(2, f"auto: {name} is '{value}', not an integer from {numbers}", *SMALL,
                                 *words, f"--{option}", "auto/8", **UNSET | {name: value})
            self.refuses(2, "auto: none of SLURM_ARRAY_TASK_ID (from 1 to 8), AWS_BATCH_JOB_ARRAY_INDEX, "
                         "JOB_COMPLETION_INDEX, OMPI_COMM_WORLD_RANK, PMI_RANK and SLURM_PROCID (from 0 to 7) is set; "
                         "outside job arrays, give a number instead of auto",
                         *SMALL, *words, f"--{option}", "auto/8", **UNSET)

    def test_shares_of_nothing_are_refused(self):
        self.refuses(2, "--frames I/N divides the pictures of a turntable or of a range: give --turntable, or "
                     "--frames A-B,I/N", *SMALL, "--frames", "1/2", "-o", "a.pfm")
        self.refuses(2, "--frames: 3 pictures cannot be divided into 4 runs: give at most 3", *SMALL, "--frames", "1-3,1/4", "-o", "a.pfm")


if __name__ == "__main__":
    main(2)
