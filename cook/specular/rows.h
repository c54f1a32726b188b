// Evaluates table and fit for rows of a CSV file, for checks with other tools.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/specular/configurations.h"
#include "formats/base/result.h"

#include <string>
#include <string_view>
#include <vector>

namespace hearth::specular
{

/// Read CSV text with the header aperture_rad,roughness,theta_o_rad,axis_x,axis_y,axis_z and six numbers in
/// each other line. Apertures are from 0 to pi / 2, roughness from 0 to 1, theta_o from 0 to pi / 2. Axes
/// have any length above 0 and are normalized. Lines may end in CR LF; empty ones are skipped.
/// errors: table_rows, naming `name` and the line.
Result<std::vector<Configuration>> readRows(std::string_view text, const std::string& name);

/// Return "table,fit" and a line for each configuration, in their order.
std::string evaluateRows(const std::vector<Configuration>& configurations, const TableValues& values,
                         SpecularSpacing spacing);

} // namespace hearth::specular
