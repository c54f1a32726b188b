// Counts the triangles of a pack's finest level.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include <cstdio>
#include <formats/pack/pack_check.h>
#include <formats/pack/pack_view.h>

namespace
{

hearth::Result<uint64_t> triangles(const char* path)
{
    using namespace hearth::formats;
    using hearth::kInvalidIndex;
    HEARTH_ASSIGN_OR_RETURN(ContainerReader reader, ContainerReader::open(path));
    HEARTH_ASSIGN_OR_RETURN(const PackView pack, PackView::read(std::move(reader)));
    HEARTH_TRY(checkPack(pack));
    uint64_t count = 0;
    for (const ClusterRecord& cluster : pack.clusters())
        count += cluster.refined_group == kInvalidIndex ? cluster.triangle_count : 0;
    return count;
}

} // namespace

int main(int argument_count, char** arguments)
{
    if (argument_count != 2)
        return 2;
    const hearth::Result<uint64_t> count = triangles(arguments[1]);
    if (!count.ok())
    {
        std::fprintf(stderr, "%s\n", hearth::formatMessage(count.error()).c_str());
        return hearth::exitCode(count.error());
    }
    std::printf("%llu\n", static_cast<unsigned long long>(*count));
    return 0;
}
