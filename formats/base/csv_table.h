// Reads CSV files of numbers, for the cookers' options that check them from outside.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hearth
{

/// Finite numbers, row by row.
struct CsvTable
{
    size_t columns = 0;
    std::vector<double> values; ///< [row_count x columns]
    std::vector<size_t> lines;  ///< [row_count] of the file, from 1 on: for messages

    size_t size() const { return lines.size(); }
    std::span<const double> row(size_t i) const { return std::span(values).subspan(i * columns, columns); }
};

/// Read text whose first line is `header`, column names divided by commas, and whose others have a number for each of
/// them. Lines may end in CR LF, numbers may have spaces around them; empty lines are skipped.
/// errors: table_rows, naming `name` and the line.
Result<CsvTable> readCsvTable(std::string_view text, std::string_view header, const std::string& name);

/// What is wrong with a line of such a file.
Error csvRowError(const std::string& name, size_t line, std::string detail);

} // namespace hearth
