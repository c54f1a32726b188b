// Converts settings into words of a cooker's command line, and units of their costs. For descriptions of
// cookers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/cookers/cooker.h"

#include <string>
#include <string_view>

namespace hearth::cookers
{

// Costs were measured with --report on GLBs of 15 MB (a rock of 400 000 triangles) and 81 MB (the demo
// scene): the larger figure per byte of source, plus a third for the next release. Two cores.
inline constexpr uint64_t kMiB = uint64_t{1} << 20;

/// Append the option once for each value of a setting; nothing where it is not set.
void addOption(const settings::Values& values, std::string_view key, const std::string& option,
               Arguments& arguments);

/// Append the option where a flag is set to true.
void addFlag(const settings::Values& values, std::string_view key, const std::string& option,
             Arguments& arguments);

/// Append "--set KEY=VALUE" for a setting; nothing where it is not set.
void addAssignment(const settings::Values& values, std::string_view key, Arguments& arguments);

/// Append "--set KEY=VALUE" for all settings of a group.
void addAssignments(const settings::Values& values, std::string_view group, Arguments& arguments);

} // namespace hearth::cookers
