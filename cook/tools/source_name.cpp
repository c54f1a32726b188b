// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/source_name.h"

#include "cook/json/json.h"

namespace hearth::tools
{

std::string readSourceName(const formats::PackView& import_part)
{
    const Json meta = Json::parse(import_part.meta()).value_or(Json());
    const Json* const sources = meta.is_object() ? meta.find("sources") : nullptr;
    const bool has_one = sources != nullptr && sources->is_array() && !sources->empty();
    return has_one && (*sources)[0].is_object() ? (*sources)[0].value("name", std::string()) : "";
}

} // namespace hearth::tools
