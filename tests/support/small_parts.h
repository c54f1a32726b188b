// Writes parts from which the pack of small_pack.h could have been linked.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/support/small_pack.h"

#include <string>

namespace hearth::test
{

/// Write import, clusters, textures and skinning parts of `pack` as
/// FOLDER/PREFIX.{import,clusters,textures,skinning}.part. The string table is in both the import and the
/// clusters part. Ends the test program on failure.
void writeParts(const PackModel& pack, const std::string& folder, const std::string& prefix);

/// Write a part with the specular tables of `pack`.
void writeSpecularPart(const PackModel& pack, const std::string& path);

/// Write a part with the light probes of `pack`.
void writeProbePart(const PackModel& pack, const std::string& path);

/// Write a part with the bricks of `pack`.
void writeBricksPart(const PackModel& pack, const std::string& path);

/// Write a part with the receivers of `pack`.
void writeReceiversPart(const PackModel& pack, const std::string& path);

/// Return a META text as hearth-import writes it, for an asset called `name`.
std::string importMeta(const std::string& name);

/// Write a pack as a file.
void writePackFile(const PackModel& pack, const std::string& path);

} // namespace hearth::test
