// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/c/handles.h"

#include "formats/records/container.h"

using namespace hearth;
using namespace hearth::c;

namespace
{

/// True if the alignment suffices to decode pages in place and read tables through typed spans.
bool isAligned(const void* bytes)
{
    return reinterpret_cast<uintptr_t>(bytes) % formats::kChunkAlignment == 0;
}

Status makeHandle(Result<pack::Pack> opened, hearth_pack** pack)
{
    HEARTH_ASSIGN_OR_RETURN(pack::Pack value, std::move(opened));
    *pack = new hearth_pack(std::move(value));
    return success();
}

} // namespace

hearth_result hearth_pack_open(const char* path, hearth_pack** pack, char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    if (path == nullptr || pack == nullptr)
                        return usage("path or pack is NULL");
                    return makeHandle(pack::Pack::open(path), pack);
                });
}

hearth_result hearth_pack_open_memory(const void* bytes, size_t size, const char* name, hearth_pack** pack,
                                      char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    if (bytes == nullptr || name == nullptr || pack == nullptr)
                        return usage("bytes, name or pack is NULL");
                    if (!isAligned(bytes))
                        return usage("bytes is not aligned to 64");
                    return makeHandle(
                        pack::Pack::fromBytes({static_cast<const std::byte*>(bytes), size}, name), pack);
                });
}

hearth_result hearth_pack_check(const hearth_pack* pack, char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status { return pack == nullptr ? usage("pack is NULL") : pack->pack.checkAll(); });
}

hearth_result hearth_pack_read_page(const hearth_pack* pack, uint32_t page, void* destination, size_t size,
                                    char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    if (pack == nullptr || destination == nullptr)
                        return usage("pack or destination is NULL");
                    if (page >= pack->pack.pageCount())
                        return usage("there is no page " + std::to_string(page));
                    if (size < pack->pack.pageSize(page))
                        return usage("page " + std::to_string(page) + " has " +
                                     std::to_string(pack->pack.pageSize(page)) + " bytes, destination " +
                                     std::to_string(size));
                    HEARTH_TRY(pack->pack.readPage(page, {static_cast<std::byte*>(destination), size}));
                    return success();
                });
}

hearth_result hearth_pack_close(hearth_pack* pack)
{
    if (pack == nullptr)
        return HEARTH_OK;
    const hearth_result unused = checkUnused(pack->message(), __func__, "pack",
                                             {{pack->scene_count, "scene", "scenes"},
                                              {pack->player_count, "player", "players"},
                                              {pack->queries_count, "queries object", "queries objects"}});
    if (unused == HEARTH_OK)
        delete pack;
    return unused;
}

const char* hearth_pack_last_error(const hearth_pack* pack)
{
    return pack == nullptr ? "" : pack->last_error;
}
