// hearth cook --watch: cooks whenever something has changed.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/cook/cook.h"

#include <functional>
#include <string>
#include <vector>

namespace hearth::command
{

/// What shall be cooked, as files of settings say now; their paths are added to `files`.
using Configure = std::function<Result<CookOptions>(std::vector<std::string>& files)>;

/// Cook, then wait until a file changes that the cook has read or looked for, or one of settings, or a source comes or goes
/// in a folder or pattern among the words; then cook again. What fails waits for its mend. Until SIGINT, SIGTERM or SIGHUP.
/// words      that sources were given by
/// returns    130; another exit code where files cannot be watched, or the options are wrong from the start
int watch(const std::vector<std::string>& words, const Configure& configure);

} // namespace hearth::command
