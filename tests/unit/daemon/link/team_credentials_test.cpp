// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The certificates are made here; those of topometric-team are tried by tests/integration/link_test.py.
#include "daemon/link/team_credentials.hpp"

#include <gmock/gmock.h>
#include <openssl/ec.h>
#include <openssl/pem.h>
#include <openssl/x509.h>
#include <sys/stat.h>
#include <unistd.h>

#include <ctime>
#include <filesystem>
#include <memory>

#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using ::testing::HasSubstr;
using types::Errc;

constexpr std::int64_t kNow_s = 1'800'000'000;
constexpr long kDay_s = 86'400;

/// A certificate of the subject, good from a day before `now` for two.
void write_certificate(const std::string& path, const char* team, const char* robot) {
  const std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)> key(EVP_EC_gen("P-256"), &EVP_PKEY_free);
  const std::unique_ptr<X509, decltype(&X509_free)> made(X509_new(), &X509_free);
  X509_NAME* name = X509_get_subject_name(made.get());
  const auto add = [name](const char* what, const char* text) {
    X509_NAME_add_entry_by_txt(name, what, MBSTRING_UTF8, reinterpret_cast<const unsigned char*>(text), -1,
                               -1, 0);
  };
  add("O", team);
  add("CN", robot);
  std::time_t now = kNow_s;
  X509_time_adj(X509_getm_notBefore(made.get()), -kDay_s, &now);
  X509_time_adj(X509_getm_notAfter(made.get()), kDay_s, &now);
  X509_set_pubkey(made.get(), key.get());
  X509_sign(made.get(), key.get(), EVP_sha256());
  std::FILE* file = std::fopen(path.c_str(), "we");
  ASSERT_NE(file, nullptr);
  PEM_write_X509(file, made.get());
  std::fclose(file);
}

class TeamCredentials : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {kIdentityCa, kPermissionsCa, kGovernance, kPermissions, kPrivateKey})
      static_cast<void>(folder.write(name, "x"));
    write_certificate(folder.file(kCertificate), "office", "robot-7");
    set_mode(kPrivateKey, 0600);
  }
  void set_mode(const char* name, mode_t mode) { ASSERT_EQ(::chmod(folder.file(name).c_str(), mode), 0); }
  [[nodiscard]] types::Status check(std::int64_t now_s = kNow_s) const {
    return check_credentials(folder.str(), "office", 7, now_s);
  }
  [[nodiscard]] std::string fault(std::int64_t now_s = kNow_s) const {
    const auto checked = check(now_s);
    return checked ? "" : checked.error().message;
  }
  testing::TempDir folder;
};

TEST_F(TeamCredentials, WholeOnesAreAccepted) { EXPECT_EQ(fault(), ""); }

TEST_F(TeamCredentials, AFileThatIsMissingIsNamed) {
  for (const char* name :
       {kIdentityCa, kCertificate, kPrivateKey, kPermissionsCa, kGovernance, kPermissions}) {
    const std::string aside = folder.file("aside");
    std::filesystem::rename(folder.file(name), aside);
    const auto checked = check();
    ASSERT_FALSE(checked.has_value()) << name;
    EXPECT_EQ(checked.error().code, Errc::kNotFound);
    EXPECT_THAT(checked.error().message, HasSubstr(name));
    std::filesystem::rename(aside, folder.file(name));
  }
}

TEST_F(TeamCredentials, KeyIsNobodyElses) {
  for (const mode_t mode : {0640U, 0604U, 0620U, 0666U}) {
    set_mode(kPrivateKey, mode);
    EXPECT_THAT(fault(), HasSubstr("expected one that nobody else reads: chmod 600")) << mode;
  }
  set_mode(kPrivateKey, 0400);
  EXPECT_EQ(fault(), "");
}

TEST_F(TeamCredentials, NobodyElseWritesTheRules) {
  for (const char* name : {kIdentityCa, kCertificate, kPermissionsCa, kGovernance, kPermissions}) {
    set_mode(name, 0664);
    EXPECT_THAT(fault(), HasSubstr("expected one that nobody else writes")) << name;
    set_mode(name, 0644);
  }
}

TEST_F(TeamCredentials, FilesOfAnotherUserAreRefused) {
  if (::chown(folder.file(kGovernance).c_str(), 65534, 65534) != 0)
    GTEST_SKIP() << "only root gives files away";
  EXPECT_THAT(fault(), HasSubstr("found a file of user 65534, expected one of user 0"));
}

TEST_F(TeamCredentials, AnothersCertificateIsNamed) {
  write_certificate(folder.file(kCertificate), "office", "robot-8");
  EXPECT_THAT(fault(),
              HasSubstr("found the credentials of robot-8 of team office, expected robot-7 of team office"));
  write_certificate(folder.file(kCertificate), "warehouse", "robot-7");
  EXPECT_THAT(fault(), HasSubstr("of team warehouse, expected robot-7 of team office"));
  static_cast<void>(folder.write(kCertificate, "no certificate"));
  EXPECT_THAT(fault(), HasSubstr("found no certificate in PEM"));
}

TEST_F(TeamCredentials, CertificateIsGoodNow) {
  EXPECT_THAT(fault(kNow_s - 2 * kDay_s), HasSubstr("is not valid yet; is this robot's clock right?"));
  EXPECT_THAT(fault(kNow_s + 2 * kDay_s), HasSubstr("has expired"));
}

}  // namespace
}  // namespace topo::daemon
