#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Wrong use of templates: the first line of the compiler with an error is a sentence that tells what is wrong.

  test_compiler_messages.py CMAKE BUILD_DIRECTORY TARGET SENTENCE
"""

import os
import re
import subprocess
import sys

CMAKE, BUILD, TARGET, SENTENCE = sys.argv[1:]

run = subprocess.run([CMAKE, "--build", BUILD, "--target", TARGET], capture_output=True, text=True,
                     env={**os.environ, "LC_ALL": "C"})
errors = [line for line in (run.stdout + run.stderr).splitlines() if re.search(r"\berror:", line)]
if run.returncode == 0 or not errors:
    sys.exit(f"{TARGET} compiles, or for another reason does not:\n{run.stdout}{run.stderr}")
if SENTENCE not in errors[0]:
    sys.exit("the first error is\n" + errors[0])
