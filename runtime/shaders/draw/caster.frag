// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450

void main() {}
