// The report for programs that know other formats: continuous integration, spreadsheets.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>

namespace hearth::report
{

// Both read JSON, and throw JsonError where the report is not as its schema says.

/// JUnit's XML: a test case for each asset, and one for what belongs to none.
std::string junitXml(const std::string& report);

/// CSV as of RFC 4180: the names of the columns, then a row for each asset.
std::string assetTable(const std::string& report);

} // namespace hearth::report
