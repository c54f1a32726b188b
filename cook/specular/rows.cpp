// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/specular/rows.h"

#include "formats/base/csv_table.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace hearth::specular
{

namespace
{

constexpr std::string_view kHeader = "aperture_rad,roughness,theta_o_rad,axis_x,axis_y,axis_z";
// Tolerance for a right angle that was written with few digits.
constexpr double kSlack_rad = 1e-5;

/// Parse a row.
/// row  six numbers; errors: table_rows
Result<Configuration> parseConfiguration(std::span<const double> row, const std::string& name, size_t line)
{
    const auto fault = [&](std::string detail) { return makeCsvRowError(name, line, std::move(detail)); };
    const double half_angle = row[0], roughness = row[1], theta_o = row[2];
    constexpr double kMaxAngle = std::numbers::pi / 2;
    if (!(half_angle >= 0 && half_angle <= kMaxAngle + kSlack_rad))
        return fault(fmt::format("aperture_rad {} is not from 0 to pi / 2", half_angle));
    if (!(roughness >= 0 && roughness <= 1))
        return fault(fmt::format("roughness {} is not from 0 to 1", roughness));
    if (!(theta_o >= 0 && theta_o <= kMaxAngle + kSlack_rad))
        return fault(fmt::format("theta_o_rad {} is not from 0 to pi / 2", theta_o));
    const Double3 axis{row[3], row[4], row[5]};
    const double size = length(axis);
    if (!(size > 0) || !std::isfinite(size))
        return fault("the axis has no direction");
    return Configuration{std::min(half_angle, kMaxAngle), roughness, std::min(theta_o, kMaxAngle),
                         axis * (1 / size)};
}

} // namespace

Result<std::vector<Configuration>> readRows(std::string_view text, const std::string& name)
{
    HEARTH_ASSIGN_OR_RETURN(const CsvTable rows, readCsvTable(text, kHeader, name));
    std::vector<Configuration> configurations;
    for (size_t i = 0; i < rows.size(); ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(const Configuration configuration,
                                parseConfiguration(rows.row(i), name, rows.lines[i]));
        configurations.push_back(configuration);
    }
    return configurations;
}

std::string evaluateRows(const std::vector<Configuration>& configurations, const TableValues& values,
                         SpecularSpacing spacing)
{
    std::string text = "table,fit\n";
    for (const Configuration& configuration : configurations)
        text += fmt::format("{:.6f},{:.6f}\n", tableOcclusion(configuration, values, spacing),
                            fitOcclusion(configuration));
    return text;
}

} // namespace hearth::specular
