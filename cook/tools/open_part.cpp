// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/open_part.h"

namespace hearth::tools
{

Result<formats::PackView> openPart(const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(formats::ContainerReader reader,
                            formats::ContainerReader::open(path, formats::Check::structure));
    if (reader.kind() != formats::ContainerKind::part)
        return Error{Issue::container_kind, path, "", "this is a pack, not a part"};
    return formats::PackView::read(std::move(reader));
}

} // namespace hearth::tools
