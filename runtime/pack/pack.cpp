// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/pack.h"

#include "formats/pack/pack_check.h"

namespace hearth::pack
{

Result<Pack> Pack::open(const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(formats::ContainerReader reader,
                            formats::ContainerReader::open(path, formats::Check::structure));
    return check(std::move(reader));
}

Result<Pack> Pack::fromBytes(std::span<const std::byte> bytes, std::string name)
{
    HEARTH_ASSIGN_OR_RETURN(
        formats::ContainerReader reader,
        formats::ContainerReader::fromBytes(bytes, std::move(name), formats::Check::structure));
    return check(std::move(reader));
}

Result<Pack> Pack::check(formats::ContainerReader reader)
{
    HEARTH_ASSIGN_OR_RETURN(formats::PackView view,
                            formats::PackView::read(std::move(reader), formats::PageBytes::left));
    HEARTH_TRY(formats::checkTables(view));
    view.enablePageChecks();
    return Pack(std::move(view));
}

Status Pack::checkAll() const
{
    HEARTH_TRY(view_.container().checkContents());
    return formats::checkPack(view_);
}

uint32_t Pack::pageSize(uint32_t page) const
{
    const size_t pages = view_.pages().size();
    return page < pages ? view_.pages()[page].size : view_.texturePieces()[page - pages].size;
}

Result<std::span<const std::byte>> Pack::readPage(uint32_t page, std::span<std::byte> out) const
{
    HEARTH_ASSERT(page < pageCount() && out.size() >= pageSize(page));
    const std::span<std::byte> target = out.first(pageSize(page));
    HEARTH_TRY(view_.decodePage(page, target));
    return std::span<const std::byte>(target);
}

} // namespace hearth::pack
