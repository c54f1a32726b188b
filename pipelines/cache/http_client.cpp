// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cache/http_client.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <curl/curl.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace hearth::cache
{

namespace
{

// 16 concurrent requests hide a millisecond of latency (measured, see pipelines/cache/README.md) without
// burdening a server.
constexpr size_t kConnections = 16;
// The body of an error response is read, so that its connection can be reused; a longer one closes the
// connection.
constexpr uint64_t kMaxErrorPage = 64 * 1024;
// Interval at which a wait checks for stalls and signals.
constexpr int kLook_ms = 100;

// ---- the library

// Loaded with dlopen, not linked: hearth starts in 2.9 ms of CPU time, or in 6.5 ms with libcurl and the 30
// libraries that it needs.
constexpr const char* kLibrary = "libcurl.so.4";

struct Curl
{
    decltype(&::curl_global_init) global_init = nullptr;
    decltype(&::curl_easy_init) easy_init = nullptr;
    decltype(&::curl_easy_reset) easy_reset = nullptr;
    decltype(&::curl_easy_setopt) set = nullptr;
    decltype(&::curl_easy_getinfo) get = nullptr;
    decltype(&::curl_easy_strerror) errorText = nullptr;
    decltype(&::curl_easy_cleanup) easy_cleanup = nullptr;
    decltype(&::curl_multi_init) multi_init = nullptr;
    decltype(&::curl_multi_add_handle) add = nullptr;
    decltype(&::curl_multi_remove_handle) remove = nullptr;
    decltype(&::curl_multi_perform) perform = nullptr;
    decltype(&::curl_multi_poll) poll = nullptr;
    decltype(&::curl_multi_info_read) nextMessage = nullptr;
    decltype(&::curl_multi_cleanup) multi_cleanup = nullptr;
};

template <typename Function>
bool find(void* library, const char* name, Function& function)
{
    function = reinterpret_cast<Function>(::dlsym(library, name));
    return function != nullptr;
}

/// Load libcurl, which then stays in memory; nullptr on failure, with dlerror() set.
const Curl* loadCurl()
{
    static Curl curl;
    if (curl.global_init != nullptr)
        return &curl;
    void* library = ::dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL);
    const bool is_whole =
        library != nullptr && find(library, "curl_easy_init", curl.easy_init) &&
        find(library, "curl_easy_reset", curl.easy_reset) && find(library, "curl_easy_setopt", curl.set) &&
        find(library, "curl_easy_getinfo", curl.get) && find(library, "curl_easy_strerror", curl.errorText) &&
        find(library, "curl_easy_cleanup", curl.easy_cleanup) &&
        find(library, "curl_multi_init", curl.multi_init) &&
        find(library, "curl_multi_add_handle", curl.add) &&
        find(library, "curl_multi_remove_handle", curl.remove) &&
        find(library, "curl_multi_perform", curl.perform) && find(library, "curl_multi_poll", curl.poll) &&
        find(library, "curl_multi_info_read", curl.nextMessage) &&
        find(library, "curl_multi_cleanup", curl.multi_cleanup) &&
        find(library, "curl_global_init", curl.global_init);
    if (!is_whole || curl.global_init(CURL_GLOBAL_DEFAULT) != CURLE_OK)
        return nullptr;
    return &curl;
}

// ---- one request

struct Flight
{
    CURL* easy = nullptr;
    HttpRequest* request = nullptr; ///< nullptr: the slot is free
    int file = -1;
    uint64_t bytes = 0;  ///< received or sent
    bool is_cut = false; ///< the response exceeds the limit
    int file_error = 0;  ///< errno of a failed file operation
    size_t text_sent = 0;
    const Curl* curl = nullptr;
    std::array<char, CURL_ERROR_SIZE> error_text{};
};

bool isGet(const HttpRequest& request)
{
    return request.kind == HttpRequest::Kind::get_text || request.kind == HttpRequest::Kind::get_file;
}

long statusOf(const Flight& flight)
{
    long status = 0;
    flight.curl->get(flight.easy, CURLINFO_RESPONSE_CODE, &status);
    return status;
}

bool makeFile(Flight& flight)
{
    if (flight.file < 0)
        flight.file = ::open(flight.request->path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    flight.file_error = flight.file < 0 ? errno : 0;
    return flight.file >= 0;
}

bool writeAll(Flight& flight, const char* data, size_t size)
{
    while (size > 0)
    {
        const ssize_t written = ::write(flight.file, data, size);
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
        {
            flight.file_error = errno;
            return false;
        }
        data += written;
        size -= static_cast<size_t>(written);
    }
    return true;
}

/// Write function for libcurl.
size_t receive(char* data, size_t one, size_t count, void* user)
{
    auto& flight = *static_cast<Flight*>(user);
    const size_t size = one * count;
    const bool is_wanted = isGet(*flight.request) && statusOf(flight) == kHttpOk;
    const uint64_t max_bytes = is_wanted ? flight.request->max_bytes : kMaxErrorPage;
    if (size > max_bytes - std::min(flight.bytes, max_bytes))
    {
        flight.is_cut = true;
        return 0;
    }
    flight.bytes += size;
    if (!is_wanted)
        return size;
    if (flight.request->kind == HttpRequest::Kind::get_text)
        flight.request->text.append(data, size);
    else if (!makeFile(flight) || !writeAll(flight, data, size))
        return 0;
    return size;
}

/// Read function for libcurl.
size_t send(char* data, size_t one, size_t count, void* user)
{
    auto& flight = *static_cast<Flight*>(user);
    const size_t room = one * count;
    size_t size = 0;
    if (flight.request->kind == HttpRequest::Kind::put_text)
    {
        size = std::min(room, flight.request->text.size() - flight.text_sent);
        std::memcpy(data, flight.request->text.data() + flight.text_sent, size);
        flight.text_sent += size;
    }
    else
    {
        const ssize_t read = ::read(flight.file, data, room);
        if (read < 0)
        {
            flight.file_error = errno;
            return CURL_READFUNC_ABORT;
        }
        size = static_cast<size_t>(read);
    }
    flight.bytes += size;
    return size;
}

/// Seek function for libcurl, which resends a request when the server has closed a kept-alive connection.
int rewind(void* user, curl_off_t offset, int origin)
{
    auto& flight = *static_cast<Flight*>(user);
    if (origin != SEEK_SET || offset < 0)
        return CURL_SEEKFUNC_CANTSEEK;
    flight.text_sent = static_cast<size_t>(offset);
    return flight.file < 0 || ::lseek(flight.file, offset, SEEK_SET) == offset ? CURL_SEEKFUNC_OK
                                                                               : CURL_SEEKFUNC_FAIL;
}

/// True if a termination signal is pending: while cookers run, signals that end the process are blocked.
bool isEndAskedFor()
{
    sigset_t pending;
    ::sigpending(&pending);
    return ::sigismember(&pending, SIGINT) == 1 || ::sigismember(&pending, SIGTERM) == 1 ||
           ::sigismember(&pending, SIGHUP) == 1;
}

} // namespace

// ---- all requests

struct HttpClient::Connections
{
    Connections(const Curl& loaded, std::string level, const Pace& wanted_pace)
        : curl(loaded), name(std::move(level)), pace(wanted_pace), patience(wanted_pace)
    {
        multi = curl.multi_init();
        for (Flight& flight : flights)
        {
            flight.curl = &curl;
            flight.easy = curl.easy_init();
        }
    }
    Connections(const Connections&) = delete;
    Connections& operator=(const Connections&) = delete;
    ~Connections()
    {
        for (const Flight& flight : flights)
            curl.easy_cleanup(flight.easy);
        curl.multi_cleanup(multi);
    }

    Error failed(const std::string& why) const { return {Issue::cache_failed, name, "", why}; }
    size_t busy() const
    {
        return static_cast<size_t>(std::count_if(
            flights.begin(), flights.end(), [](const Flight& flight) { return flight.request != nullptr; }));
    }
    uint64_t bytesSoFar() const
    {
        uint64_t bytes = bytes_landed;
        for (const Flight& flight : flights)
            bytes += flight.bytes;
        return bytes;
    }
    Status start(Flight& flight, HttpRequest& request);
    Status land(Flight& flight, CURLcode end);
    Status landAll();
    void giveUp();

    const Curl& curl;
    std::string name;
    Pace pace;
    Patience patience;
    CURLM* multi = nullptr;
    std::array<Flight, kConnections> flights;
    uint64_t bytes_landed = 0;
    uint64_t requests_landed = 0;
};

Status HttpClient::Connections::start(Flight& flight, HttpRequest& request)
{
    flight.file = -1;
    flight.bytes = 0;
    flight.is_cut = false;
    flight.file_error = 0;
    flight.text_sent = 0;
    flight.error_text[0] = '\0';
    auto put_bytes = static_cast<curl_off_t>(request.text.size());
    if (request.kind == HttpRequest::Kind::put_file)
    {
        struct stat info = {};
        flight.file = ::open(request.path.c_str(), O_RDONLY | O_CLOEXEC);
        if (flight.file < 0 || ::fstat(flight.file, &info) != 0)
            return failed("cannot read " + request.path + ": " + std::strerror(errno));
        put_bytes = info.st_size;
    }
    flight.request = &request;
    curl.easy_reset(flight.easy);
    curl.set(flight.easy, CURLOPT_URL, request.url.c_str());
    curl.set(flight.easy, CURLOPT_PROTOCOLS_STR, "http,https");
    curl.set(flight.easy, CURLOPT_HTTP_VERSION, static_cast<long>(CURL_HTTP_VERSION_1_1));
    curl.set(flight.easy, CURLOPT_USERAGENT, "hearth");
    curl.set(flight.easy, CURLOPT_CONNECTTIMEOUT_MS, static_cast<long>(pace.connect_s * 1000));
    // a name server that does not answer must not delay the end of the process
    curl.set(flight.easy, CURLOPT_QUICK_EXIT, 1L);
    curl.set(flight.easy, CURLOPT_ERRORBUFFER, flight.error_text.data());
    curl.set(flight.easy, CURLOPT_PRIVATE, &flight);
    curl.set(flight.easy, CURLOPT_WRITEFUNCTION, &receive);
    curl.set(flight.easy, CURLOPT_WRITEDATA, &flight);
    if (!isGet(request))
    {
        curl.set(flight.easy, CURLOPT_UPLOAD, 1L);
        curl.set(flight.easy, CURLOPT_INFILESIZE_LARGE, put_bytes);
        curl.set(flight.easy, CURLOPT_READFUNCTION, &send);
        curl.set(flight.easy, CURLOPT_READDATA, &flight);
        curl.set(flight.easy, CURLOPT_SEEKFUNCTION, &rewind);
        curl.set(flight.easy, CURLOPT_SEEKDATA, &flight);
    }
    curl.add(multi, flight.easy);
    return success();
}

/// Finish a request that has been answered or has failed.
Status HttpClient::Connections::land(Flight& flight, CURLcode end)
{
    curl.remove(multi, flight.easy);
    HttpRequest& request = *flight.request;
    const long status = statusOf(flight);
    const bool is_answered = end == CURLE_OK || flight.is_cut;
    const bool makes_file = request.kind == HttpRequest::Kind::get_file && status == kHttpOk && is_answered;
    const bool is_well = is_answered && (!makes_file || makeFile(flight));
    const bool has_made_file = request.kind == HttpRequest::Kind::get_file && flight.file >= 0;
    if (flight.file >= 0)
        ::close(flight.file);
    bytes_landed += flight.bytes;
    flight.bytes = 0;
    flight.request = nullptr;
    if (is_well)
    {
        ++requests_landed;
        request.status = status;
        return success();
    }
    if (has_made_file)
        ::unlink(request.path.c_str());
    if (flight.file_error != 0)
        return failed("cannot use " + request.path + ": " + std::strerror(flight.file_error));
    return failed(flight.error_text[0] != '\0' ? flight.error_text.data() : curl.errorText(end));
}

Status HttpClient::Connections::landAll()
{
    int left = 0;
    while (const CURLMsg* message = curl.nextMessage(multi, &left))
    {
        if (message->msg != CURLMSG_DONE)
            continue;
        const CURLcode end = message->data.result;
        char* user = nullptr;
        curl.get(message->easy_handle, CURLINFO_PRIVATE, &user);
        HEARTH_TRY(land(*reinterpret_cast<Flight*>(user), end));
    }
    return success();
}

void HttpClient::Connections::giveUp()
{
    for (Flight& flight : flights)
        if (flight.request != nullptr)
            static_cast<void>(land(flight, CURLE_ABORTED_BY_CALLBACK).ok());
}

HttpClient::HttpClient(std::unique_ptr<Connections> connections) : connections_(std::move(connections)) {}

HttpClient::~HttpClient() = default;

Result<std::unique_ptr<HttpClient>> HttpClient::open(const std::string& name, const Pace& pace)
{
    const Curl* curl = loadCurl();
    if (curl == nullptr)
    {
        const char* why = ::dlerror();
        return Error{Issue::cache_failed, name, "",
                     std::string("needs libcurl (Debian's libcurl4): ") +
                         (why != nullptr ? why : "it cannot be initialised")};
    }
    return std::unique_ptr<HttpClient>(new HttpClient(std::make_unique<Connections>(*curl, name, pace)));
}

Status HttpClient::run(std::span<HttpRequest> requests)
{
    Connections& all = *connections_;
    using Clock = std::chrono::steady_clock;
    const auto flyThem = [&]() -> Status
    {
        auto next = requests.begin();
        for (auto last_look = Clock::now(); next != requests.end() || all.busy() > 0;)
        {
            for (Flight& flight : all.flights)
                if (flight.request == nullptr && next != requests.end())
                    HEARTH_TRY(all.start(flight, *next++));
            const uint64_t bytes_before = all.bytesSoFar();
            const uint64_t requests_before = all.requests_landed;
            int running = 0;
            all.curl.perform(all.multi, &running);
            HEARTH_TRY(all.landAll());
            if (all.busy() == kConnections || (all.busy() > 0 && next == requests.end()))
                all.curl.poll(all.multi, nullptr, 0, kLook_ms, nullptr);
            const auto now = Clock::now();
            const double waited_s = std::chrono::duration<double>(now - last_look).count();
            last_look = now;
            if (!all.patience.spend(waited_s, all.requests_landed - requests_before,
                                    all.bytesSoFar() - bytes_before))
                return all.failed("is too slow to be of use");
            if (isEndAskedFor())
                return all.failed("is not waited for, as a signal ends the cook");
        }
        return success();
    };
    Status flown = flyThem();
    if (!flown.ok())
        all.giveUp();
    return flown;
}

} // namespace hearth::cache
