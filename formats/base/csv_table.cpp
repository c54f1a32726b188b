// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/csv_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace hearth
{

namespace
{

std::string_view trim(std::string_view text)
{
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
        text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r'))
        text.remove_suffix(1);
    return text;
}

/// Split the part before `separator` off `rest`.
std::string_view takeField(std::string_view& rest, char separator)
{
    const size_t end = std::min(rest.find(separator), rest.size());
    const std::string_view part = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    return part;
}

/// Append the numbers of a line. errors: table_rows
Status readRow(CsvTable& rows, std::string_view row, const std::string& name, size_t line)
{
    size_t count = 0;
    for (bool more = true; more; ++count)
    {
        more = row.find(',') != std::string_view::npos;
        const std::string_view cell = trim(takeField(row, ','));
        if (count >= rows.columns)
            continue; // keep counting, for the message
        double value = 0;
        const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
        if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
            return makeCsvRowError(name, line, "'" + std::string(cell) + "' is not a number");
        rows.values.push_back(value);
    }
    if (count != rows.columns)
        return makeCsvRowError(name, line,
                               "has " + std::to_string(count) + " columns, " + std::to_string(rows.columns) +
                                   " are needed");
    rows.lines.push_back(line);
    return success();
}

} // namespace

Error makeCsvRowError(const std::string& name, size_t line, std::string detail)
{
    return {Issue::table_rows, name, "line " + std::to_string(line), std::move(detail)};
}

Result<CsvTable> readCsvTable(std::string_view text, std::string_view header, const std::string& name)
{
    if (text.starts_with("\xEF\xBB\xBF"))
        text.remove_prefix(3); // spreadsheets write a UTF-8 byte order mark
    std::string first;
    for (const char c : trim(takeField(text, '\n')))
        if (c != ' ' && c != '\t')
            first += c;
    if (first != header)
        return makeCsvRowError(name, 1, "is not '" + std::string(header) + "'");
    CsvTable rows;
    rows.columns = static_cast<size_t>(std::count(header.begin(), header.end(), ',')) + 1;
    for (size_t line = 2; !text.empty(); ++line)
        if (const std::string_view row = trim(takeField(text, '\n')); !row.empty())
            HEARTH_TRY(readRow(rows, row, name, line));
    return rows;
}

} // namespace hearth
