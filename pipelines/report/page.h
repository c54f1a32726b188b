// The page of a report: one file of HTML with all that it needs inside, so that it opens anywhere and asks for nothing.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>

namespace hearth::report
{

/// data, pictures  JSON, of page_data.h
std::string reportPage(const std::string& data, const std::string& pictures);

} // namespace hearth::report
