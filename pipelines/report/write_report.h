// The report of a cook in the forms that people and machines read.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/report/pictures.h"

#include <string>

namespace hearth::report
{

/// Write a report where it is wanted: as a page where `path` ends in .html, as JUnit's XML for .xml, as a table for .csv, and
/// else as the JSON that it is.
///
/// json     of schema hearth.report/1
/// pack     that was cooked, for the page's pictures; empty: none
/// told     of the page's pictures; empty: is not
/// errors   json_syntax, naming `name`; cannot_write; read_failed for standard output
Status writeReport(const std::string& json, const std::string& path, const std::string& pack,
                   const std::string& name = "report", const PicturesDrawn& told = {});

} // namespace hearth::report
