// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cache/cache_spec.h"

#include "formats/base/text.h"

#include <charconv>
#include <cstdlib>

namespace hearth::cache
{

namespace
{

constexpr std::string_view kFolderScheme = "dir:";

/// True if a URL that starts with http:// or https:// names a host.
bool hasHost(const std::string& url)
{
    const size_t start = url.find("//") + 2;
    const std::string authority = url.substr(start, url.find('/', start) - start);
    const std::string after_user = authority.substr(authority.rfind('@') + 1);
    return !after_user.empty() && after_user[0] != ':';
}

Result<CacheSpec> parseCacheSpec(const std::string& text, const std::string& option)
{
    const auto wrong = [&](const std::string& why) {
        return Error{Issue::usage, option + " " + text, "", why};
    };
    const bool is_server = text.starts_with("http://") || text.starts_with("https://");
    if (!is_server && !text.starts_with(kFolderScheme))
        return wrong("must be a folder or a server, as in dir:/var/cache/hearth, dir:/mnt/team,ro or "
                     "http://cache:8080/hearth");
    const std::vector<std::string> parts =
        splitText(is_server ? text : text.substr(kFolderScheme.size()), ',');
    CacheSpec spec;
    spec.place = parts[0];
    spec.is_server = is_server;
    if (is_server && !hasHost(spec.place))
        return wrong("names no host");
    if (is_server)
        spec.place.resize(spec.place.find_last_not_of('/') + 1);
    if (is_server && spec.place.find_first_of("?# ") != std::string::npos)
        return wrong("must end with the path that ac/ and cas/ lie under");
    if (spec.place.empty())
        return wrong("names no folder");
    for (size_t i = 1; i < parts.size(); ++i)
        if (parts[i] == "ro")
            spec.writable = false;
        else if (!is_server && parts[i].starts_with("size="))
        {
            HEARTH_ASSIGN_OR_RETURN(spec.limit_bytes, parseSize(parts[i].substr(5), option + " " + text));
        }
        else if (is_server)
            return wrong("'" + parts[i] + "' is not known: only ,ro may follow the URL");
        else
            return wrong("'" + parts[i] + "' is not known: only ,ro and ,size=20G may follow the folder");
    return spec;
}

std::string environmentVariable(const char* name)
{
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
}

/// Return the user's cache directory; empty where the user has no home.
std::string userCacheFolder()
{
    if (const std::string caches = environmentVariable("XDG_CACHE_HOME"); !caches.empty())
        return caches + "/hearth";
    const std::string home = environmentVariable("HOME");
    return home.empty() ? "" : home + "/.cache/hearth";
}

/// Apply HEARTH_CACHE_MODE: machines of a team share cache locations but differ in their permissions.
Status applyCacheMode(std::vector<CacheSpec>& specs)
{
    const std::string mode = environmentVariable("HEARTH_CACHE_MODE");
    if (mode == "off")
        specs.clear();
    for (CacheSpec& spec : specs)
        spec.writable = spec.writable && mode != "ro";
    if (mode.empty() || mode == "rw" || mode == "ro" || mode == "off")
        return success();
    return Error{Issue::usage, "HEARTH_CACHE_MODE", "", "'" + mode + "' must be rw, ro or off"};
}

} // namespace

Result<uint64_t> parseSize(const std::string& text, const std::string& option)
{
    uint64_t size = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), size);
    const std::string_view unit(end, static_cast<size_t>(text.data() + text.size() - end));
    const unsigned shift = unit.empty() ? 0 : unit == "K" ? 10 : unit == "M" ? 20 : unit == "G" ? 30 : 40;
    const bool is_known = unit.empty() || unit == "K" || unit == "M" || unit == "G" || unit == "T";
    if (error != std::errc() || !is_known || size == 0 || size > (UINT64_MAX >> shift))
        return Error{Issue::usage, option, "", "'" + text + "' is no size: write 512M or 20G"};
    return size << shift;
}

Result<std::vector<CacheSpec>> resolveCacheSpecs(std::span<const std::string> options)
{
    std::vector<CacheSpec> specs;
    std::string option = "--cache";
    std::vector<std::string> texts(options.begin(), options.end());
    if (const std::string value = environmentVariable("HEARTH_CACHE"); texts.empty() && !value.empty())
    {
        if (value == "off")
            return specs;
        option = "HEARTH_CACHE";
        texts = splitText(value, ';');
    }
    for (const std::string& text : texts)
    {
        HEARTH_ASSIGN_OR_RETURN(CacheSpec spec, parseCacheSpec(text, option));
        specs.push_back(std::move(spec));
    }
    if (const std::string folder = userCacheFolder(); texts.empty() && !folder.empty())
    {
        specs.emplace_back();
        specs.back().place = folder;
    }
    HEARTH_TRY(applyCacheMode(specs));
    return specs;
}

} // namespace hearth::cache
