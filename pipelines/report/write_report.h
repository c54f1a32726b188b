// Writes the report of a cook in formats for people and machines.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/report/images.h"

#include <string>

namespace hearth::report
{

/// Write a report in the format of its file extension: a page for .html, JUnit XML for .xml, a table for
/// .csv, else JSON.
///
/// json     of schema hearth.report/1
/// pack     cooked pack, for the page's images; empty: none
/// progress  of the page's images; may be empty
/// errors   json_syntax, naming `name`; cannot_write; read_failed for standard output
Status writeReport(const std::string& json, const std::string& path, const std::string& pack,
                   const std::string& name = "report", const ImageProgress& progress = {});

} // namespace hearth::report
