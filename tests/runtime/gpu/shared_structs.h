// Structs of formats/gpu_shared that cross to shaders in blocks, as C++ lays them out.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hearth::test
{

struct SharedMember
{
    std::string name;
    size_t offset;
    std::string type;    ///< "uint", "int", "float", "float2" to "float4", or the name of a struct
    size_t element_size; ///< of an array; 0: no array
};

struct SharedStruct
{
    std::string name;
    size_t size;
    std::vector<SharedMember> members;
};

const std::vector<SharedStruct>& sharedStructs();

} // namespace hearth::test
