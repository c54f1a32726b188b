// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/extract/extract_specular.h"

#include "formats/base/atomic_file.h"
#include "formats/pack/pack_check.h"
#include "pipelines/command/extract/open_pack.h"

#include <fmt/format.h>

namespace hearth::command
{

using namespace formats;

Status extractSpecular(const std::string& path, const std::string& output)
{
    HEARTH_ASSIGN_OR_RETURN(const PackView file, openContainer(path));
    HEARTH_TRY(checkSpecular(file)); // openContainer does not check this chunk of a part
    if (file.specularTables().empty())
        return Error{Issue::chunk_missing, path, chunkName(kChunkSpecular, 0),
                     "the file has no table of specular occlusion"};
    const SpecularTableRecord& table = file.specularTables()[0];
    const auto spacing = static_cast<SpecularSpacing>(table.spacing);
    constexpr uint32_t kNodes = shared::kSpecularNodes;
    std::string text = "aperture,roughness,cos_beta,value\n";
    for (uint32_t i = 0; i < kSpecularTexels; ++i)
        text += fmt::format("{:.7g},{:.7g},{:.7g},{:.7g}\n", specularNodeAperture(i % kNodes),
                            specularNodeRoughness(i / kNodes % kNodes),
                            specularNodeCosBeta(i / kNodes / kNodes, spacing), table.values[i] / 255.0);
    HEARTH_ASSIGN_OR_RETURN(AtomicFile csv, AtomicFile::create(output));
    csv.write(text);
    return csv.finish();
}

} // namespace hearth::command
