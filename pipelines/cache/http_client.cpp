// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cache/http_client.h"

#include "formats/base/regular_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <curl/curl.h>
#include <dlfcn.h>
#include <fcntl.h>
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
constexpr int kPollInterval_ms = 100;

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

struct Transfer
{
    CURL* easy = nullptr;
    HttpRequest* request = nullptr; ///< nullptr: the slot is free
    int file = -1;
    uint64_t bytes = 0;        ///< received or sent
    bool is_truncated = false; ///< the response exceeds the limit
    int file_error = 0;        ///< errno of a failed file operation
    size_t text_sent = 0;
    const Curl* curl = nullptr;
    std::array<char, CURL_ERROR_SIZE> error_text{};
};

bool isGet(const HttpRequest& request)
{
    return request.kind == HttpRequest::Kind::get_text || request.kind == HttpRequest::Kind::get_file;
}

long httpStatus(const Transfer& transfer)
{
    long status = 0;
    transfer.curl->get(transfer.easy, CURLINFO_RESPONSE_CODE, &status);
    return status;
}

bool createFile(Transfer& transfer)
{
    if (transfer.file < 0)
        transfer.file = ::open(transfer.request->path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    transfer.file_error = transfer.file < 0 ? errno : 0;
    return transfer.file >= 0;
}

bool writeAll(Transfer& transfer, const char* data, size_t size)
{
    while (size > 0)
    {
        const ssize_t written = ::write(transfer.file, data, size);
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
        {
            transfer.file_error = errno;
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
    auto& transfer = *static_cast<Transfer*>(user);
    const size_t size = one * count;
    const bool is_wanted = isGet(*transfer.request) && httpStatus(transfer) == kHttpOk;
    const uint64_t max_bytes = is_wanted ? transfer.request->max_bytes : kMaxErrorPage;
    if (size > max_bytes - std::min(transfer.bytes, max_bytes))
    {
        transfer.is_truncated = true;
        return 0;
    }
    transfer.bytes += size;
    if (!is_wanted)
        return size;
    if (transfer.request->kind == HttpRequest::Kind::get_text)
        transfer.request->text.append(data, size);
    else if (!createFile(transfer) || !writeAll(transfer, data, size))
        return 0;
    return size;
}

/// Read function for libcurl.
size_t send(char* data, size_t one, size_t count, void* user)
{
    auto& transfer = *static_cast<Transfer*>(user);
    const size_t room = one * count;
    size_t size = 0;
    if (transfer.request->kind == HttpRequest::Kind::put_text)
    {
        size = std::min(room, transfer.request->text.size() - transfer.text_sent);
        std::memcpy(data, transfer.request->text.data() + transfer.text_sent, size);
        transfer.text_sent += size;
    }
    else
    {
        const ssize_t read = ::read(transfer.file, data, room);
        if (read < 0)
        {
            transfer.file_error = errno;
            return CURL_READFUNC_ABORT;
        }
        size = static_cast<size_t>(read);
    }
    transfer.bytes += size;
    return size;
}

/// Seek function for libcurl, which resends a request when the server has closed a kept-alive connection.
int rewind(void* user, curl_off_t offset, int origin)
{
    auto& transfer = *static_cast<Transfer*>(user);
    if (origin != SEEK_SET || offset < 0)
        return CURL_SEEKFUNC_CANTSEEK;
    transfer.text_sent = static_cast<size_t>(offset);
    return transfer.file < 0 || ::lseek(transfer.file, offset, SEEK_SET) == offset ? CURL_SEEKFUNC_OK
                                                                                   : CURL_SEEKFUNC_FAIL;
}

/// True if a termination signal is pending: while cookers run, signals that end the process are blocked.
bool isTerminationPending()
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
    Connections(const Curl& loaded, std::string level, const StallLimits& stall_limits)
        : curl(loaded), name(std::move(level)), limits(stall_limits), stall_timer(stall_limits)
    {
        multi = curl.multi_init();
        for (Transfer& transfer : transfers)
        {
            transfer.curl = &curl;
            transfer.easy = curl.easy_init();
        }
    }
    Connections(const Connections&) = delete;
    Connections& operator=(const Connections&) = delete;
    ~Connections()
    {
        for (const Transfer& transfer : transfers)
            curl.easy_cleanup(transfer.easy);
        curl.multi_cleanup(multi);
    }

    Error failed(const std::string& why) const { return {Issue::cache_failed, name, "", why}; }
    size_t busy() const
    {
        return static_cast<size_t>(std::count_if(transfers.begin(), transfers.end(),
                                                 [](const Transfer& transfer)
                                                 { return transfer.request != nullptr; }));
    }
    uint64_t bytesSoFar() const
    {
        uint64_t bytes = bytes_finished;
        for (const Transfer& transfer : transfers)
            bytes += transfer.bytes;
        return bytes;
    }
    Status start(Transfer& transfer, HttpRequest& request);
    Status finish(Transfer& transfer, CURLcode end);
    Status finishAll();
    void abortAll();

    const Curl& curl;
    std::string name;
    StallLimits limits;
    StallTimer stall_timer;
    CURLM* multi = nullptr;
    std::array<Transfer, kConnections> transfers;
    uint64_t bytes_finished = 0;
    uint64_t requests_finished = 0;
};

Status HttpClient::Connections::start(Transfer& transfer, HttpRequest& request)
{
    transfer.file = -1;
    transfer.bytes = 0;
    transfer.is_truncated = false;
    transfer.file_error = 0;
    transfer.text_sent = 0;
    transfer.error_text[0] = '\0';
    auto put_bytes = static_cast<curl_off_t>(request.text.size());
    if (request.kind == HttpRequest::Kind::put_file)
    {
        RegularFile file(request.path);
        if (!file.isOpen())
            return failed("cannot read " + request.path + ": " + std::strerror(file.openError()));
        put_bytes = static_cast<curl_off_t>(file.size());
        transfer.file = file.release();
    }
    transfer.request = &request;
    curl.easy_reset(transfer.easy);
    curl.set(transfer.easy, CURLOPT_URL, request.url.c_str());
    curl.set(transfer.easy, CURLOPT_PROTOCOLS_STR, "http,https");
    curl.set(transfer.easy, CURLOPT_HTTP_VERSION, static_cast<long>(CURL_HTTP_VERSION_1_1));
    curl.set(transfer.easy, CURLOPT_USERAGENT, "hearth");
    curl.set(transfer.easy, CURLOPT_CONNECTTIMEOUT_MS, static_cast<long>(limits.connect_timeout_s * 1000));
    // a name server that does not answer must not delay the end of the process
    curl.set(transfer.easy, CURLOPT_QUICK_EXIT, 1L);
    curl.set(transfer.easy, CURLOPT_ERRORBUFFER, transfer.error_text.data());
    curl.set(transfer.easy, CURLOPT_PRIVATE, &transfer);
    curl.set(transfer.easy, CURLOPT_WRITEFUNCTION, &receive);
    curl.set(transfer.easy, CURLOPT_WRITEDATA, &transfer);
    if (!isGet(request))
    {
        curl.set(transfer.easy, CURLOPT_UPLOAD, 1L);
        curl.set(transfer.easy, CURLOPT_INFILESIZE_LARGE, put_bytes);
        curl.set(transfer.easy, CURLOPT_READFUNCTION, &send);
        curl.set(transfer.easy, CURLOPT_READDATA, &transfer);
        curl.set(transfer.easy, CURLOPT_SEEKFUNCTION, &rewind);
        curl.set(transfer.easy, CURLOPT_SEEKDATA, &transfer);
    }
    curl.add(multi, transfer.easy);
    return success();
}

/// Finish a request that has been answered or has failed.
Status HttpClient::Connections::finish(Transfer& transfer, CURLcode end)
{
    curl.remove(multi, transfer.easy);
    HttpRequest& request = *transfer.request;
    const long status = httpStatus(transfer);
    const bool is_answered = end == CURLE_OK || transfer.is_truncated;
    const bool creates_file = request.kind == HttpRequest::Kind::get_file && status == kHttpOk && is_answered;
    const bool has_succeeded = is_answered && (!creates_file || createFile(transfer));
    const bool has_created_file = request.kind == HttpRequest::Kind::get_file && transfer.file >= 0;
    if (transfer.file >= 0)
        ::close(transfer.file);
    bytes_finished += transfer.bytes;
    transfer.bytes = 0;
    transfer.request = nullptr;
    if (has_succeeded)
    {
        ++requests_finished;
        request.status = status;
        return success();
    }
    if (has_created_file)
        ::unlink(request.path.c_str());
    if (transfer.file_error != 0)
        return failed("cannot use " + request.path + ": " + std::strerror(transfer.file_error));
    return failed(transfer.error_text[0] != '\0' ? transfer.error_text.data() : curl.errorText(end));
}

Status HttpClient::Connections::finishAll()
{
    int left = 0;
    while (const CURLMsg* message = curl.nextMessage(multi, &left))
    {
        if (message->msg != CURLMSG_DONE)
            continue;
        const CURLcode end = message->data.result;
        char* user = nullptr;
        curl.get(message->easy_handle, CURLINFO_PRIVATE, &user);
        HEARTH_TRY(finish(*reinterpret_cast<Transfer*>(user), end));
    }
    return success();
}

void HttpClient::Connections::abortAll()
{
    for (Transfer& transfer : transfers)
        if (transfer.request != nullptr)
            static_cast<void>(finish(transfer, CURLE_ABORTED_BY_CALLBACK).ok());
}

HttpClient::HttpClient(std::unique_ptr<Connections> connections) : connections_(std::move(connections)) {}

HttpClient::~HttpClient() = default;

Result<std::unique_ptr<HttpClient>> HttpClient::open(const std::string& name, const StallLimits& limits)
{
    const Curl* curl = loadCurl();
    if (curl == nullptr)
    {
        const char* why = ::dlerror();
        return Error{Issue::cache_failed, name, "",
                     std::string("needs libcurl (Debian's libcurl4): ") +
                         (why != nullptr ? why : "it cannot be initialised")};
    }
    return std::unique_ptr<HttpClient>(new HttpClient(std::make_unique<Connections>(*curl, name, limits)));
}

Status HttpClient::run(std::span<HttpRequest> requests)
{
    Connections& all = *connections_;
    using Clock = std::chrono::steady_clock;
    const auto runTransfers = [&]() -> Status
    {
        auto next = requests.begin();
        for (auto last_check = Clock::now(); next != requests.end() || all.busy() > 0;)
        {
            for (Transfer& transfer : all.transfers)
                if (transfer.request == nullptr && next != requests.end())
                    HEARTH_TRY(all.start(transfer, *next++));
            const uint64_t bytes_before = all.bytesSoFar();
            const uint64_t requests_before = all.requests_finished;
            int running = 0;
            all.curl.perform(all.multi, &running);
            HEARTH_TRY(all.finishAll());
            if (all.busy() == kConnections || (all.busy() > 0 && next == requests.end()))
                all.curl.poll(all.multi, nullptr, 0, kPollInterval_ms, nullptr);
            const auto now = Clock::now();
            const double waited_s = std::chrono::duration<double>(now - last_check).count();
            last_check = now;
            if (!all.stall_timer.addWait(waited_s, all.requests_finished - requests_before,
                                         all.bytesSoFar() - bytes_before))
                return all.failed("is too slow to be of use");
            if (isTerminationPending())
                return all.failed("is not waited for, as a signal ends the cook");
        }
        return success();
    };
    Status outcome = runTransfers();
    if (!outcome.ok())
        all.abortAll();
    return outcome;
}

} // namespace hearth::cache
