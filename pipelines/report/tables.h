// Report in formats of other programs: continuous integration, spreadsheets.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>

namespace hearth::report
{

// Both functions read JSON, and throw JsonError where the report violates its schema.

/// Convert to JUnit XML: a test case for each asset, and one for failures that belong to no asset.
std::string junitXml(const std::string& report);

/// Convert to CSV (RFC 4180): the names of the columns, then a row for each asset.
std::string assetTable(const std::string& report);

} // namespace hearth::report
