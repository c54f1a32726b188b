// Prints the results of a corpus run.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/corpus/judge.h"

#include <span>

namespace hearth::corpus
{

/// Print every failure with its reasons and the cook's first messages.
void printFailures(std::span<const Checked> all);

/// Print files of medium confidence whose outcome deviates from their class.
void printMedium(std::span<const Checked> all);

/// Print the ten slowest files with their time and memory.
void printSlowest(std::span<const Checked> all);

/// Print passed and failed files by class and confidence.
void printTable(std::span<const Checked> all);

} // namespace hearth::corpus
