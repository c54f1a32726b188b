// Which shard a process shall run: told on the command line, or by the batch system that started it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <functional>
#include <string>

namespace hearth::farm
{

/// A variable of the environment by name; nullptr where it is not set.
using Environment = std::function<const char*(const char* name)>;

/// The shard, counted from 0. The first of these that says something: `option`, SLURM_ARRAY_TASK_ID, JOB_COMPLETION_INDEX
/// (Kubernetes), AWS_BATCH_JOB_ARRAY_INDEX, SGE_TASK_ID, PBS_ARRAY_INDEX. Slurm and SGE tell the range that they count
/// through: it must be as long as the plan has shards, and may start anywhere, without gaps. The others count from 0.
///
/// option  "I/N" with I < N, or empty
/// count   shards of the plan, which N must be
/// errors  usage
Result<size_t> shardIndex(const std::string& option, size_t count, const Environment& environment);

} // namespace hearth::farm
