// Whole files or none, on POSIX calls: they tell why a write failed, which streams do not.
#include "perf/report/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "engine/error.h"

namespace halfframe::perf {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* doing, int error) {
    const char* advice = "choose another place for it";
    if (error == ENOSPC || error == EDQUOT || error == EFBIG) {
        advice = "free some space or choose another disk";
    } else if (error == ENOENT || error == ENOTDIR) {
        advice = "make its folder first or correct the path";
    } else if (error == EACCES || error == EPERM || error == EROFS) {
        advice = "choose a folder that you may write";
    }
    throw Error(Fault::environment, "cannot write " + path.string() + " (" + doing + ": " +
                                        std::generic_category().message(error) + "); " + advice);
}

/// The file beside the wished one; takes itself away unless it was renamed.
class PartialFile {
public:
    explicit PartialFile(const std::filesystem::path& path)
        : path_(path), partial_(path.string() + ".partial." + std::to_string(::getpid())) {
        struct stat there {};
        if (::stat(path.c_str(), &there) == 0 && !S_ISREG(there.st_mode)) {
            throw Error(Fault::environment,
                        "cannot write " + path.string() + ": it exists and is no regular file; choose another name");
        }
        descriptor_ = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
        if (descriptor_ < 0) {
            fail(path_, "opening", errno);
        }
    }
    ~PartialFile() {
        if (descriptor_ >= 0) {
            ::close(descriptor_);
        }
        if (!renamed_) {
            ::unlink(partial_.c_str());
        }
    }
    PartialFile(const PartialFile&) = delete;
    PartialFile& operator=(const PartialFile&) = delete;

    void write(std::span<const std::uint8_t> bytes) {
        while (!bytes.empty()) {
            const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
            if (written < 0) {
                if (errno == EINTR) {
                    continue;
                }
                fail(path_, "writing", errno);
            }
            bytes = bytes.subspan(static_cast<std::size_t>(written));
        }
    }

    /// A full disk may only show when the file is closed: closing is checked before the rename.
    void finish() {
        const int closed = ::close(descriptor_);
        descriptor_ = -1;
        if (closed != 0) {
            fail(path_, "closing", errno);
        }
        if (::rename(partial_.c_str(), path_.c_str()) != 0) {
            fail(path_, "renaming", errno);
        }
        renamed_ = true;
    }

private:
    std::filesystem::path path_;
    std::filesystem::path partial_;
    int descriptor_ = -1;
    bool renamed_ = false;
};

}  // namespace

void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
    PartialFile file(path);
    file.write(bytes);
    file.finish();
}

void write_file(const std::filesystem::path& path, std::string_view text) {
    write_file(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void expect_can_write(const std::filesystem::path& path) { const PartialFile probe(path); }

}  // namespace halfframe::perf
