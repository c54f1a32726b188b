// HTML page of a report: one self-contained file that loads nothing else.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>

namespace hearth::report
{

/// Make the page.
/// data, images  JSON, of page_data.h
std::string reportPage(const std::string& data, const std::string& images);

} // namespace hearth::report
