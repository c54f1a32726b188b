// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/verify/verify_pack.h"

#include "cook/json/json_events.h"
#include "formats/pack/pack_check.h"

#include <tbb/parallel_for.h>

#include <set>
#include <utility>

namespace hearth::verify
{

namespace
{

/// Stops the parser at arrays and objects that are nested too deeply.
class DepthCheck final : public JsonEvents
{
public:
    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool integer(int64_t) override { return true; }
    bool unsignedInteger(uint64_t) override { return true; }
    bool number(double) override { return true; }
    bool string(std::string&) override { return true; }
    bool key(std::string&) override { return true; }
    bool beginArray() override { return open(); }
    bool endArray() override { return close(); }
    bool beginObject() override { return open(); }
    bool endObject() override { return close(); }

    bool isTooDeep() const { return depth_ > formats::kMaxExtrasDepth; }

private:
    bool open()
    {
        ++depth_;
        return !isTooDeep();
    }
    bool close()
    {
        --depth_;
        return true;
    }
    uint32_t depth_ = 0;
};

/// Check that extras are JSON. Texts that several objects share are parsed once. Others may not overlap:
/// parsing them would take quadratic time.
Status checkExtras(const formats::PackView& view)
{
    std::set<std::pair<uint32_t, uint32_t>> checked; // offset and length
    uint64_t bytes = 0;
    for (size_t i = 0; i < view.extras().size(); ++i)
    {
        const formats::StringRef json = view.extras()[i].json;
        if (!checked.emplace(json.offset, json.length).second)
            continue;
        const auto fail = [&](Issue issue, const char* detail) {
            return Error{issue, view.name(), "extras " + std::to_string(i), detail};
        };
        bytes += json.length;
        if (bytes > view.strings().size())
            return fail(Issue::meaning_range, "the texts of extras overlap");
        DepthCheck depth;
        if (parseJson(view.text(json), depth))
            return fail(Issue::meaning_value, "the text is not JSON");
        if (depth.isTooDeep())
            return fail(Issue::meaning_value, "the JSON text is nested too deeply");
    }
    return success();
}

} // namespace

Status verifyPack(const formats::PackView& view)
{
    HEARTH_TRY(formats::checkPack(view, [](uint32_t count, const std::function<void(uint32_t)>& work)
                                  { tbb::parallel_for(uint32_t{0}, count, work); }));
    return checkExtras(view);
}

} // namespace hearth::verify
