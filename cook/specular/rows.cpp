// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/specular/rows.h"

#include <charconv>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace hearth::specular
{

namespace
{

constexpr std::string_view kHeader = "aperture_rad,roughness,theta_o_rad,axis_x,axis_y,axis_z";
constexpr size_t kColumns = 6;
// a right angle that was written with few digits
constexpr double kSlack_rad = 1e-5;

std::string_view trimmed(std::string_view text)
{
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
        text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r'))
        text.remove_suffix(1);
    return text;
}

/// Takes the part of `rest` in front of `separator` away from it.
std::string_view next(std::string_view& rest, char separator)
{
    const size_t end = std::min(rest.find(separator), rest.size());
    const std::string_view part = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    return part;
}

class RowReader
{
public:
    RowReader(const std::string& name, size_t line) : name_(name), line_(line) {}

    Error fault(std::string detail) const
    {
        return {Issue::table_rows, name_, "line " + std::to_string(line_), std::move(detail)};
    }

    Result<Configuration> read(std::string_view row) const
    {
        std::array<double, kColumns> values{};
        size_t count = 0;
        for (bool more = true; more; ++count)
        {
            more = row.find(',') != std::string_view::npos;
            const std::string_view cell = trimmed(next(row, ','));
            if (count >= kColumns)
                continue; // counts on, for the message
            const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), values[count]);
            if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(values[count]))
                return fault(fmt::format("'{}' is not a number", cell));
        }
        if (count != kColumns)
            return fault(fmt::format("has {} columns, {} are needed", count, kColumns));
        return configurationOf(values);
    }

private:
    Result<Configuration> configurationOf(const std::array<double, kColumns>& values) const
    {
        const auto [half_angle, roughness, theta_o, x, y, z] = values;
        constexpr double kRightAngle = std::numbers::pi / 2;
        if (!(half_angle >= 0 && half_angle <= kRightAngle + kSlack_rad))
            return fault(fmt::format("aperture_rad {} is not from 0 to pi / 2", half_angle));
        if (!(roughness >= 0 && roughness <= 1))
            return fault(fmt::format("roughness {} is not from 0 to 1", roughness));
        if (!(theta_o >= 0 && theta_o <= kRightAngle + kSlack_rad))
            return fault(fmt::format("theta_o_rad {} is not from 0 to pi / 2", theta_o));
        const Double3 axis{x, y, z};
        const double size = length(axis);
        if (!(size > 0) || !std::isfinite(size))
            return fault("the axis has no direction");
        return Configuration{std::min(half_angle, kRightAngle), roughness, std::min(theta_o, kRightAngle),
                             axis * (1 / size)};
    }

    const std::string& name_;
    size_t line_;
};

} // namespace

Result<std::vector<Configuration>> readRows(std::string_view text, const std::string& name)
{
    size_t line = 1;
    if (text.starts_with("\xEF\xBB\xBF"))
        text.remove_prefix(3); // spreadsheets begin UTF-8 so
    std::string header;
    for (const char c : trimmed(next(text, '\n')))
        if (c != ' ' && c != '\t')
            header += c;
    if (header != kHeader)
        return RowReader(name, line).fault(fmt::format("is not '{}'", kHeader));
    std::vector<Configuration> configurations;
    while (!text.empty())
    {
        const RowReader reader(name, ++line);
        const std::string_view row = trimmed(next(text, '\n'));
        if (row.empty())
            continue;
        HEARTH_ASSIGN_OR_RETURN(const Configuration configuration, reader.read(row));
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
