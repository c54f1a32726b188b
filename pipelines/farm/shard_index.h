// Finds the index of the shard to run, from the command line or from the batch system that started the
// process.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <functional>
#include <string>

namespace hearth::farm
{

/// Return a variable of the environment; nullptr where it is not set.
using Environment = std::function<const char*(const char* name)>;

/// Return the shard, counted from 0, from the first of these that is set: `option`, SLURM_ARRAY_TASK_ID,
/// JOB_COMPLETION_INDEX (Kubernetes), AWS_BATCH_JOB_ARRAY_INDEX, SGE_TASK_ID, PBS_ARRAY_INDEX. Slurm and SGE
/// give the range of their index: it must be as long as the plan has shards, without gaps, and may start
/// anywhere. The others count from 0.
///
/// option  "I/N" with I < N, or empty
/// count   number of shards of the plan, which N must equal
/// errors  usage
Result<size_t> shardIndex(const std::string& option, size_t count, const Environment& environment);

} // namespace hearth::farm
