# Reads and writes float images as PFM, the exchange format of this bench: colour, little-endian, rows from
# bottom to top.
# SPDX-License-Identifier: LicenseRef-Hearth-Undecided
import numpy


def write(path, pixels):
    """Write an array of (height, width, 3), first row at the bottom."""
    height, width = pixels.shape[:2]
    with open(path, "wb") as file:
        file.write(b"PF\n%d %d\n-1.0\n" % (width, height))
        file.write(pixels.astype("<f4").tobytes())


def read(path):
    """Return an array of (height, width, 3), first row at the bottom."""
    with open(path, "rb") as file:
        if file.readline().strip() != b"PF":
            raise ValueError(path + " is no colour PFM")
        width, height = (int(word) for word in file.readline().split())
        if float(file.readline()) >= 0:
            raise ValueError(path + " is not little-endian")
        return numpy.frombuffer(file.read(), "<f4").reshape(height, width, 3)
