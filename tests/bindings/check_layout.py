# SPDX-License-Identifier: LicenseRef-Hearth-Undecided
"""check_layout.py TABLE: compare hearth.py with a table of the C compiler; print each difference."""
import ctypes
import sys

import hearth


def find_struct(name):
    words = name.removeprefix("hearth_").split("_")
    return getattr(hearth, "".join(word[:1].upper() + word[1:] for word in words))


def compare(kind, name, *expected):
    if kind == "constant":
        return str(getattr(hearth, name.removeprefix("HEARTH_"))), expected[0]
    if kind == "function":
        return callable(getattr(hearth, name.removeprefix("hearth_"), None)), True
    if kind == "default":
        return bytes(find_struct(name)()).hex(), expected[0]
    if kind == "struct":
        return str(ctypes.sizeof(find_struct(name))), expected[0]
    struct, field = name.split(".")
    place = getattr(find_struct(struct), field)
    return (str(place.offset), str(place.size)), expected


with open(sys.argv[1], encoding="utf-8") as table:
    for line in table:
        found, expected = compare(*line.split())
        if found != expected:
            print(f"{line.strip()}: {found}")
