// hearth cook --dry-run: what a cook would run, and why.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/cook/cook.h"
#include "pipelines/graph/resolver.h"

#include <string>

namespace hearth::command
{

/// Print what would run to stdout, and write nothing.
/// returns  the exit code; 1 where a cooker would run, or the pack would be put in its place, and options.dry_run_checks.
///          Problems have been told on stderr
int dryRun(const CookOptions& options);

/// Why the pack would be put in its place, where nothing runs; empty where it is as it should be.
std::string packCause(const graph::Forecast& forecast, const std::optional<std::string>& hash_there);

} // namespace hearth::command
