// The parts that small_pack.h's pack could have been linked from.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/support/small_pack.h"

#include <string>

namespace hearth::test
{

/// Write import, clusters, textures and skinning parts of `pack` as FOLDER/PREFIX.{import,clusters,textures,skinning}.part.
/// The string table stands in both import and clusters parts. Ends the test program where it cannot.
void writeParts(const PackModel& pack, const std::string& folder, const std::string& prefix);

/// Write a part with the specular tables of `pack`.
void writeSpecularPart(const PackModel& pack, const std::string& path);

/// Write a part with the bricks of `pack`.
void writeBricksPart(const PackModel& pack, const std::string& path);

/// A META text as hearth-import writes it, of an asset called `name`.
std::string importMeta(const std::string& name);

/// Write a pack as a file.
void writePackFile(const PackModel& pack, const std::string& path);

} // namespace hearth::test
