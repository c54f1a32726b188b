// Confines this process, before it reads what strangers wrote.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>

namespace hearth::images
{

inline constexpr uint64_t kMaxMemory_bytes = uint64_t{4} << 30;
inline constexpr unsigned kMaxCpu_s = 60;

/// Limit memory to kMaxMemory_bytes and processor time to kMaxCpu_s, forbid core files and files that grow,
/// and close all open files but standard input, output and error. The process ends with its parent. Under a
/// sanitizer, which reserves terabytes, memory has no limit.
void limitResources();

/// Let the processor time count anew, for the next image.
void renewCpuLimit();

/// Forbid this process, all its threads included, whatever does not serve computing: no file is opened, no
/// other process or network is reached. Forbidden calls fail with EPERM. Never undone.
/// returns  false if the kernel has no such filter, or none for this processor; files cannot be opened even
///          then, since the limit of open files is reached
bool closeDoors();

} // namespace hearth::images
