// Reads CSV files of numbers, for cooker options that check results against external data.
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

/// Table of finite numbers, row by row.
struct CsvTable
{
    size_t columns = 0;
    std::vector<double> values; ///< [row_count x columns]
    std::vector<size_t> lines;  ///< [row_count] line numbers in the file, from 1 on: for messages

    size_t size() const { return lines.size(); }
    std::span<const double> row(size_t i) const { return std::span(values).subspan(i * columns, columns); }
};

/// Read text whose first line is `header`, column names separated by commas. Every other line has one number
/// for each column. Lines may end in CR LF, numbers may have spaces around them; empty lines are skipped.
/// errors: table_rows, naming `name` and the line.
Result<CsvTable> readCsvTable(std::string_view text, std::string_view header, const std::string& name);

/// Return the error of a line of a CSV file.
Error makeCsvRowError(const std::string& name, size_t line, std::string detail);

} // namespace hearth
