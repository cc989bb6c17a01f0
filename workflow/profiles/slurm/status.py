#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tells snakemake how a job of Slurm is: running, success or failed.

  status.py JOB
"""

import subprocess
import sys

FAILED = ("BOOT_FAIL", "CANCELLED", "DEADLINE", "FAILED", "NODE_FAIL", "OUT_OF_MEMORY", "PREEMPTED", "TIMEOUT")


def main():
    job = sys.argv[1].split(";")[0]  # sbatch --parsable may name the cluster after it
    run = subprocess.run(["sacct", "--noheader", "--parsable2", "--allocations", "--format=State", "--jobs", job],
                         capture_output=True, text=True)
    state = (run.stdout.split() or [""])[0]
    # Accounting lags behind: what it does not know yet is running.
    print("success" if state == "COMPLETED" else "failed" if state in FAILED else "running")


if __name__ == "__main__":
    main()
