// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/make_connector.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <string>

#include "drivers/io/posix.hpp"

namespace topo::io {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using types::Errc;

TEST(MakeConnector, TakesEveryDocumentedForm) {
  for (const char* address : {"serial:/dev/ttyUSB0", "/dev/ttyUSB0", "tcp:192.168.0.10:10940",
                              "tcp:[::1]:10940", "tcp:robot-a:1"}) {
    const auto connector = make_connector(address);
    ASSERT_TRUE(connector) << connector.error().message;
    EXPECT_EQ((*connector)->name(), address);
  }
}

TEST(MakeConnector, NamesWhatWasFoundAndWhatIsExpected) {
  for (const char* address :
       {"", "ttyUSB0", "usb:/dev/x", "serial:ttyUSB0", "serial:", "tcp:", "tcp:host", "tcp::10940",
        "tcp:host:", "tcp:host:0", "tcp:host:65536", "tcp:host:80x", "tcp:::1:10940", "tcp:host:-1"}) {
    const auto connector = make_connector(address);
    ASSERT_FALSE(connector) << address;
    EXPECT_EQ(connector.error().code, Errc::kInvalidInput);
    EXPECT_THAT(connector.error().message, HasSubstr(std::string("\"") + address + "\""));
    EXPECT_THAT(connector.error().message, HasSubstr("tcp:HOST:PORT"));
  }
}

TEST(SerialConnector, NamesAMissingDevice) {
  auto connector = make_connector("/dev/topometric-has-no-such-device");
  ASSERT_TRUE(connector);
  const auto stream = (*connector)->connect(10ms);
  ASSERT_FALSE(stream);
  EXPECT_EQ(stream.error().code, Errc::kNotFound);
  EXPECT_THAT(stream.error().message, HasSubstr("/dev/topometric-has-no-such-device"));
}

TEST(SerialConnector, RefusesAFileThatIsNoSerialDevice) {
  const std::string path = testing::TempDir() + "topo_not_serial";
  std::ofstream(path) << "x";
  auto connector = make_connector("serial:" + path);
  ASSERT_TRUE(connector);
  const auto stream = (*connector)->connect(10ms);
  ASSERT_FALSE(stream);
  EXPECT_EQ(stream.error().code, Errc::kInvalidInput);
  EXPECT_THAT(stream.error().message, HasSubstr("not a serial device"));
  ::unlink(path.c_str());
}

TEST(SerialConnector, TellsWhichGroupToJoin) {
  // Made by hand: root, who runs tests in containers, may open everything.
  const types::Status failure = fail_open("/dev/topometric-has-no-such-device", EACCES);
  EXPECT_EQ(failure.error().code, Errc::kPermission);
  EXPECT_EQ(failure.error().sys_errno, EACCES);
  EXPECT_THAT(failure.error().message, HasSubstr("/dev/topometric-has-no-such-device"));
  EXPECT_THAT(failure.error().message, HasSubstr("must be in the group dialout"));
}

}  // namespace
}  // namespace topo::io
