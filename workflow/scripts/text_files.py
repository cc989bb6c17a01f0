# SPDX-License-Identifier: GPL-3.0-or-later
"""Text files that are written all at once."""

import os


def write_text(path, text):
    """All of it, or nothing."""
    partial = f"{path}.part"
    with open(partial, "w", encoding="utf-8", newline="\n") as file:
        file.write(text)
    os.replace(partial, path)
