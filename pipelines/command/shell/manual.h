// hearth man: generates manual pages from the tables of options and settings.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/command_line/command_info.h"
#include "formats/base/result.h"

#include <string>
#include <utility>
#include <vector>

namespace hearth::command
{

struct ManualPage
{
    std::string name; ///< "hearth-cook.1", "hearth.toml.5"
    std::string text; ///< as man(7) macros
};

/// Return hearth(1), a page for each verb, and hearth.toml(5).
std::vector<ManualPage> manualPages(const cli::CommandInfo& hearth);

} // namespace hearth::command
