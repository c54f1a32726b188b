// Evaluates rows of numbers, for checking from outside.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/specular/configurations.h"
#include "formats/base/result.h"

#include <string>
#include <string_view>
#include <vector>

namespace hearth::specular
{

/// Read text whose first line is aperture_rad,roughness,theta_o_rad,axis_x,axis_y,axis_z and whose others have six numbers
/// each. Apertures from 0 to pi / 2, roughness from 0 to 1, theta_o from 0 to pi / 2, axes of any length above 0, which
/// are made unit. Lines may end in CR LF; empty ones are skipped.
/// errors: table_rows, naming `name` and the line.
Result<std::vector<Configuration>> readRows(std::string_view text, const std::string& name);

/// "table,fit" and a line for each configuration, in their order.
std::string evaluateRows(const std::vector<Configuration>& configurations, const TableValues& values,
                         SpecularSpacing spacing);

} // namespace hearth::specular
