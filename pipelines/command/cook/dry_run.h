// hearth cook --dry-run: prints what a cook would run, and why.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/cook/cook.h"
#include "pipelines/graph/resolver.h"

#include <string>

namespace hearth::command
{

/// Print to stdout what would run, and write nothing.
/// returns  the exit code; with options.dry_run_checks 1 if a cooker would run, or the pack would be put into
///          place. Problems have been printed on stderr
int dryRun(const CookOptions& options);

/// Return the reason why the pack would be put into place although nothing runs; empty if it is up to date.
std::string packCause(const graph::Forecast& forecast, const std::optional<std::string>& old_pack_hash);

} // namespace hearth::command
