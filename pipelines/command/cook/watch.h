// hearth cook --watch: cooks again whenever an input changes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/cook/cook.h"

#include <functional>
#include <string>
#include <vector>

namespace hearth::command
{

/// Function that returns the options of the next cook, by the present configuration files; appends their
/// paths to `files`.
using MakeOptions = std::function<Result<CookOptions>(std::vector<std::string>& files)>;

/// Cook, then wait for a change and cook again, until SIGINT, SIGTERM or SIGHUP. Changes are: of a file that
/// the cook has read or probed, of a configuration file, and of the sources in a folder or pattern among the
/// words. A failed cook waits for a change, too.
/// words      words of the command line that the sources come from
/// returns    130; another exit code if files cannot be watched, or the options are wrong from the start
int watch(const std::vector<std::string>& words, const MakeOptions& make_options);

} // namespace hearth::command
