// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/base_connector.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace topo::pioneer {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using types::Errc;

TEST(BaseConnector, TakesEveryDocumentedForm) {
  for (const char* address : {"can:can0", "can:can0:0", "can:vcan12:7", "serial:/dev/ttyUSB0", "/dev/ttyUSB0",
                              "tcp:192.168.0.10:8101"}) {
    const auto connector = make_base_connector(address);
    ASSERT_TRUE(connector) << connector.error().message;
    EXPECT_EQ((*connector)->name(), address);
  }
  EXPECT_EQ(*parse_can_address("can:can0"), (CanAddress{"can0", 0}));
  EXPECT_EQ(*parse_can_address("can:can1:5"), (CanAddress{"can1", 5}));
  EXPECT_FALSE(*parse_can_address("tcp:can:1"));
}

TEST(BaseConnector, NamesWhatWasFoundAndWhatIsExpected) {
  for (const char* address :
       {"can:", "can::0", "can:can0:", "can:can0:8", "can:can0:-1", "can:can0:00", "can:can0:a",
        "can:can0:1:1", "can:a-name-beyond-all", "can:../can0", "usb:can0", "can0"}) {
    const auto connector = make_base_connector(address);
    ASSERT_FALSE(connector) << address;
    EXPECT_EQ(connector.error().code, Errc::kInvalidInput);
    EXPECT_THAT(connector.error().message, HasSubstr(std::string("\"") + address + "\""));
    EXPECT_THAT(connector.error().message, HasSubstr("can:INTERFACE:UNIT"));
  }
}

TEST(BaseConnector, AMissingInterfaceIsNamedWithItsCure) {
  auto connector = make_base_connector("can:no-such-can:0");
  ASSERT_TRUE(connector) << connector.error().message;
  const auto stream = (*connector)->connect(milliseconds(10));
  ASSERT_FALSE(stream);
  EXPECT_EQ(stream.error().code, Errc::kNotFound);
  EXPECT_THAT(stream.error().message, HasSubstr("there is no interface no-such-can"));
  EXPECT_THAT(stream.error().message, HasSubstr("ip -br link"));
}

TEST(BaseConnector, AnInterfaceOfAnotherKindIsRefused) {
  const auto stream = (*make_base_connector("can:lo"))->connect(milliseconds(10));
  ASSERT_FALSE(stream);
  EXPECT_THAT(stream.error().message, HasSubstr("lo is no CAN interface"));
}

}  // namespace
}  // namespace topo::pioneer
