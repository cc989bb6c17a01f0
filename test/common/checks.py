# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks of a test that goes on after a failure: failures are counted, and the first ones printed."""

MOST_PRINTED = 40
failures = 0


def check(condition, *text):
    global failures
    if condition:
        return
    failures += 1
    if failures <= MOST_PRINTED:
        print("FAILED:", *text)


def exit_code(*counts):
    """Prints how many checks failed, after other counts, as "3 files"."""
    print(", ".join([*counts, f"{failures} failures"]))
    return 1 if failures else 0
