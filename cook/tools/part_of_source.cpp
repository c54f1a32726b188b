// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/part_of_source.h"

#include <algorithm>
#include <charconv>

namespace hearth::tools
{

Result<PartOfSource> parsePartOfSource(const std::string& text, size_t source_count,
                                       const std::string& program, const std::string& option)
{
    const size_t equals = std::min(text.find('='), text.size());
    size_t source = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + equals, source);
    if (parsed.ec != std::errc() || parsed.ptr != text.data() + equals || equals + 1 >= text.size() ||
        source >= source_count)
        return Error{Issue::usage, program, option,
                     text + ": the number of a source is needed before the part, below " +
                         std::to_string(source_count) + ", as in 0=rock.proxy.part"};
    return PartOfSource{source, text.substr(equals + 1)};
}

} // namespace hearth::tools
