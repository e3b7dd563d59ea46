// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/link/team_credentials.hpp"

#include <fmt/format.h>
#include <openssl/pem.h>
#include <openssl/x509.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <memory>

namespace topo::daemon {
namespace {

using types::Errc;
using types::fail;
using types::Status;

constexpr std::array<const char*, 6> kFiles{kIdentityCa,    kCertificate, kPrivateKey,
                                            kPermissionsCa, kGovernance,  kPermissions};

Status check_file(const std::string& path, bool secret) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    const int error = errno;
    return fail(error == ENOENT ? Errc::kNotFound : Errc::kPermission,
                fmt::format("team.security: {}: {}; expected a robot's folder made by topometric-team", path,
                            std::strerror(error)),
                error);
  }
  if (!S_ISREG(status.st_mode))
    return fail(Errc::kInvalidInput, fmt::format("team.security: {}: found no regular file", path));
  if (status.st_uid != ::geteuid() && status.st_uid != 0)
    return fail(
        Errc::kPermission,
        fmt::format(
            "team.security: {}: found a file of user {}, expected one of user {}, who runs topolink, or "
            "of root: chown it",
            path, status.st_uid, ::geteuid()));
  // A key of root may be lent to the link's group; "others" are never meant.
  const mode_t forbidden = secret ? (status.st_uid == ::geteuid() ? 0077 : 0037) : 0022;
  if ((status.st_mode & forbidden) != 0)
    return fail(Errc::kPermission,
                fmt::format("team.security: {}: found mode {:04o}, expected {}: chmod {} it", path,
                            status.st_mode & 07777,
                            secret ? "one that nobody else reads" : "one that nobody else writes",
                            secret ? "600" : "644"));
  if (::access(path.c_str(), R_OK) != 0)
    return fail(Errc::kPermission, fmt::format("team.security: {}: {}", path, std::strerror(errno)), errno);
  return {};
}

struct Closes {
  void operator()(std::FILE* file) const { std::fclose(file); }
  void operator()(X509* certificate) const { X509_free(certificate); }
};

std::string entry(const X509_NAME* name, int what) {
  std::array<char, 256> text{};
  if (X509_NAME_get_text_by_NID(name, what, text.data(), text.size()) < 0) return {};
  return text.data();
}

Status check_certificate(const std::string& path, const std::string& team, int robot, std::int64_t now_s) {
  const std::unique_ptr<std::FILE, Closes> file(std::fopen(path.c_str(), "re"));
  const std::unique_ptr<X509, Closes> certificate(file ? PEM_read_X509(file.get(), nullptr, nullptr, nullptr)
                                                       : nullptr);
  if (!certificate)
    return fail(Errc::kInvalidInput, fmt::format("team.security: {}: found no certificate in PEM", path));
  const X509_NAME* subject = X509_get_subject_name(certificate.get());
  const std::string named = entry(subject, NID_organizationName), number = entry(subject, NID_commonName);
  if (named != team || number != fmt::format("robot-{}", robot))
    return fail(
        Errc::kInvalidInput,
        fmt::format("team.security: {}: found the credentials of {} of team {}, expected robot-{} of team {}",
                    path, number, named, robot, team));
  std::time_t now = static_cast<std::time_t>(now_s);
  if (X509_cmp_time(X509_get0_notBefore(certificate.get()), &now) > 0)
    return fail(
        Errc::kInvalidInput,
        fmt::format("team.security: {}: the certificate is not valid yet; is this robot's clock right?",
                    path));
  if (X509_cmp_time(X509_get0_notAfter(certificate.get()), &now) < 0)
    return fail(
        Errc::kInvalidInput,
        fmt::format("team.security: {}: the certificate has expired; topometric-team add makes a new one",
                    path));
  return {};
}

}  // namespace

Status check_credentials(const std::string& folder, const std::string& team, int robot, std::int64_t now_s) {
  for (const char* name : kFiles) {
    if (auto checked = check_file(folder + "/" + name, name == kPrivateKey); !checked) return checked;
  }
  return check_certificate(folder + "/" + kCertificate, team, robot, now_s);
}

}  // namespace topo::daemon
