// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/extract/open_pack.h"

#include "formats/pack/pack_check.h"
#include "pipelines/verify/verify_pack.h"

#include <fmt/format.h>

namespace hearth::command
{

using namespace formats;

namespace
{

Result<PackView> readContainer(const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(ContainerReader reader, ContainerReader::open(path, Check::everything));
    return PackView::read(std::move(reader));
}

} // namespace

Result<PackView> openContainer(const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(PackView view, readContainer(path));
    if (view.container().kind() == ContainerKind::pack)
        HEARTH_TRY(verify::verifyPack(view));
    else
    {
        HEARTH_TRY(checkBricks(view));
        HEARTH_TRY(checkReceivers(view));
        HEARTH_TRY(checkProxies(view));
    }
    return view;
}

Result<PackView> openPack(const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(PackView view, readContainer(path));
    HEARTH_TRY(verify::verifyPack(view));
    return view;
}

Status checkMesh(const PackView& pack, const std::string& path, uint32_t mesh)
{
    if (mesh < pack.meshes().size())
        return success();
    return Error{Issue::usage, path, "",
                 fmt::format("there is no mesh {}: the file has {}", mesh, pack.meshes().size())};
}

} // namespace hearth::command
