// Writes the part of receivers, and its statistics.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/receivers/program/cook_receivers.h"

namespace hearth::receivers
{

/// Write the part: the chunks of receivers, and META. Without receivers META says why there is none.
/// errors: cannot_write
Status writeReceiversPart(const std::string& path, const CookedReceivers& cooked,
                          const CookSettings& settings);

/// Return statistics as JSON, schema "hearth.receivers/1".
std::string statisticsJson(const CookedReceivers& cooked, const CookSettings& settings);

} // namespace hearth::receivers
