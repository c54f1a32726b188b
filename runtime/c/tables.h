// Checks of calls that name records of a pack's tables.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/c/handles.h"

namespace hearth::c
{

/// Check that the pack is not NULL and has the record.
/// table  HEARTH_TABLE_*
/// errors: usage.
Status checkRecord(const hearth_pack* pack, uint32_t table, uint32_t index);

} // namespace hearth::c
