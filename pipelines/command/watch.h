// hearth cook --watch: cooks whenever something has changed.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/cook.h"

namespace hearth::command
{

/// Cook, then wait until a file changes that the cook has read or looked for, and cook again; a cook that fails waits
/// for its mend. Until SIGINT, SIGTERM or SIGHUP.
/// returns    130; another exit code where files cannot be watched, or the options are wrong
int watch(const CookOptions& options);

} // namespace hearth::command
