// Decodes Draco data. A shared library of its own: libdraco.a holds a copy of tinygltf of another version,
// whose symbols would be mixed up with those of libtinygltf.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hearth::test
{

struct DracoAttribute
{
    uint32_t id = 0;
    int component_type = 0; ///< glTF's number, 5126 for floats; 0: another type, without values
    size_t components = 1;
    std::vector<double> values; ///< for each point, as stored: integers are not normalised
};

struct DracoMesh
{
    std::string error; ///< empty if the data could be decoded
    std::vector<size_t> indices;
    std::vector<DracoAttribute> attributes;
};

[[gnu::visibility("default")]] DracoMesh decodeDraco(const std::vector<uint8_t>& bytes);

} // namespace hearth::test
