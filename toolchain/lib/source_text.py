# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""Reading C++ text for checks that need no compiler: comments and literals blanked, line numbers kept."""

import pathlib
import re

TOP = pathlib.Path(__file__).resolve().parent.parent.parent
# Seeded faults live there: they must not turn the real checks red.
SEEDS = "tests/canary/seeds"

_TOKEN = re.compile(
    r"""//[^\n]*|/\*.*?\*/                      # comments
      | R"(?P<tag>[^\s()\\]{0,16})\(.*?\)(?P=tag)"  # raw strings
      | "(?:\\.|[^"\\\n])*"                    # strings
      | '(?:\\[^'\n]{1,10}|\\'|[^'\\\n])'      # characters; 1'000 is not one
    """,
    re.S | re.X,
)


def _blank(text):
    return re.sub(r"[^\n]", " ", text)


def without_comments(text):
    """Comments blanked; literals kept, so that `//` inside one does not hide code."""
    return _TOKEN.sub(lambda match: _blank(match.group()) if match.group().startswith("/") else match.group(), text)


def code_only(text):
    """Comments and literals blanked: what is left is code."""
    return _TOKEN.sub(lambda match: _blank(match.group()), text)


def line_of(text, offset):
    return text.count("\n", 0, offset) + 1
