// What the run found, for people.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/corpus/judge.h"

#include <span>

namespace hearth::corpus
{

/// Every failure with its reasons and the cook's first messages.
void printFailures(std::span<const Checked> all);

/// Files of medium confidence that came out otherwise than their class.
void printMedium(std::span<const Checked> all);

/// The ten files that took longest, and what they needed.
void printSlowest(std::span<const Checked> all);

/// Passed and failed by class and confidence.
void printTable(std::span<const Checked> all);

} // namespace hearth::corpus
