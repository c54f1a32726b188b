#!/usr/bin/env python3
# SPDX-License-Identifier: LicenseRef-Hearth-Undecided
"""make_bindings.py --header HEARTH.H LIBRARY ... [--python FILE] [--csharp FILE]: make bindings of the C API.

A header names the file of the library that has its functions; later headers may use types of earlier ones.
Needs Python 3.9 and nothing else. Exit code 1, and no output, if a header has something that bindings
cannot have.
"""
import argparse
import os
import re
import sys

from c_header import HeaderError, read_header
from csharp_binding import write_csharp
from python_binding import write_python


def write_whole(path, text):
    """Write a file, whole or not at all."""
    with open(path + ".part", "w", encoding="utf-8", newline="\n") as file:
        file.write(text)
    os.replace(path + ".part", path)


def main():
    options = argparse.ArgumentParser(description=__doc__,
                                      formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--header", nargs=2, action="append", required=True, metavar=("FILE", "LIBRARY"))
    options.add_argument("--python", metavar="FILE")
    options.add_argument("--csharp", metavar="FILE")
    arguments = options.parse_args()
    header, libraries = None, {}
    try:
        for path, file in arguments.header:
            library = re.sub(r"^lib|\.so.*$", "", file)
            header = read_header(path, library, header)
            libraries[library] = file
        writers = ((arguments.python, write_python), (arguments.csharp, write_csharp))
        outputs = [(path, write(header, libraries)) for path, write in writers if path]
        for path, text in outputs:
            write_whole(path, text)
    except (HeaderError, OSError) as error:
        sys.exit(f"make_bindings.py: error: {error}")


if __name__ == "__main__":
    main()
