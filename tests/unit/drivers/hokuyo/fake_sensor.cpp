// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/drivers/hokuyo/fake_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tests/unit/drivers/hokuyo/scip_text.hpp"

namespace topo::hokuyo::testing_scip {

using types::Duration;
using types::Stamp;
using Kind = StreamRequest::Kind;

FakeSensor::FakeSensor(mocks::ScriptedLine& line, const Sample& sample)
    : vv(sample.vv), pp(sample.pp), ii(sample.ii), line_(line), sample_(sample), counter_zero_(line.now) {
  line_.on_write = [this](std::string_view bytes) { on_write(bytes); };
  line_.on_wait = [this](Stamp until) { on_wait(until); };
  line_.on_connect = [this] { partial_.clear(); };
}

int FakeSensor::count(std::string_view command) const {
  return static_cast<int>(std::count_if(
      heard.begin(), heard.end(), [&](const std::string& request) { return request.starts_with(command); }));
}

void FakeSensor::power_cycle() {
  laser = streaming = adjust = false;
  counter_zero_ = line_.now;
  counter_start_ms = 0.0;
}

std::uint32_t FakeSensor::counter(Stamp t) const {
  const double ms = counter_start_ms +
                    (frozen ? 0.0 : types::to_seconds(t - counter_zero_) * 1e3 / (1.0 + drift_ppm * 1e-6));
  return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(ms)) & 0xFFFFFF);
}

void FakeSensor::answer(const std::string& echo, const std::string& status, const std::string& lines) {
  line_.send_at(line_.now + out + back, reply_text(echo, status, lines));
}

void FakeSensor::on_write(std::string_view bytes) {
  if (baud != 0 && line_.baud != baud) return;
  for (const char c : bytes) {
    if (c != '\n') {
      partial_ += c;
      continue;
    }
    const std::string request = partial_;
    partial_.clear();
    if (request.empty()) continue;
    heard.push_back(request);
    if (mute || (" " + mute_commands + " ").find(" " + request.substr(0, 2) + " ") != std::string::npos)
      continue;
    on_request(request);
  }
}

void FakeSensor::on_request(const std::string& request) {
  if (scip1) {
    if (request == "SCIP2.0") scip1 = false;
    line_.send_at(line_.now + out + back, request + (request == "SCIP2.0" ? "\n0\n\n" : "\nE\n\n"));
    return;
  }
  if (request.starts_with("TM")) return on_adjust_request(request);
  if (adjust && request != "RS") return answer(request, "10");
  if (request == "VV") return answer(request, "00", vv);
  if (request == "PP") return answer(request, "00", pp);
  if (request == "II") return answer(request, "00", ii);
  if (request == "QT") {
    laser = streaming = false;
    return answer(request, "00");
  }
  if (request == "RS") {
    ++resets;
    power_cycle();
    return answer(request, "00");
  }
  if (request == "BM") {
    if (laser_failures != 0) {
      if (laser_failures > 0) --laser_failures;
      return answer(request, "01");
    }
    answer(request, laser ? "02" : "00");
    laser = true;
    return;
  }
  if (request == "RB") {
    if (line_.now - last_reboot_request_ < std::chrono::seconds(1)) {
      ++reboots;
      power_cycle();
      line_.unplug();
      return;
    }
    last_reboot_request_ = line_.now;
    return answer(request, "01");
  }
  if (parse_stream_echo(request)) return start_stream(request);
  answer(request, "0E");
}

void FakeSensor::on_adjust_request(const std::string& request) {
  if (streaming) return answer(request, "10");
  if (request == "TM0") {
    adjust = adjust_status == "00";
    return answer(request, adjust_status);
  }
  if (request == "TM2") {
    answer(request, adjust ? "00" : "03");
    adjust = false;
    return;
  }
  if (!adjust) return answer(request, "04");
  answer(request, "00", with_sum(number(counter(line_.now + out), 4)));
}

void FakeSensor::start_stream(const std::string& request) {
  stream_ = *parse_stream_echo(request);
  stream_echo_ = request;
  const bool wants_intensity = stream_.kind == Kind::kRangeIntensity;
  if (wants_intensity && sample_.family == Family::kUrg) {
    mute = true;  // as the real one: hangs until its power is cut
    return;
  }
  answer(request, "00");
  laser = streaming = true;
  next_scan_ = line_.now + std::chrono::milliseconds(5);
}

void FakeSensor::on_wait(Stamp until) {
  const Duration turn = types::from_seconds(60.0 / sample_.rpm);
  while (streaming && next_scan_ + turn * sample_.amax / sample_.ares + latency <= until) {
    send_scan(next_scan_);
    next_scan_ += turn * (stream_.interval + 1);
  }
}

void FakeSensor::send_scan(Stamp begin) {
  if (mute || mute_scans) return;
  if (swallow_scans > 0) {
    --swallow_scans;
    return;
  }
  const Duration turn = types::from_seconds(60.0 / sample_.rpm);
  const Stamp when = begin + turn * sample_.amax / sample_.ares + latency;
  if (!inject_status.empty()) {
    line_.send_at(when, reply_text(stream_echo_, inject_status));
    if (inject_status >= "50" && inject_status != "98") streaming = laser = false;
    inject_status.clear();
    return;
  }
  std::string data;
  for (std::size_t i = 0; i < stream_.points(); ++i) {
    data += number(range_mm(stream_.start + i * std::max<std::size_t>(stream_.cluster, 1)), 3);
    if (stream_.kind == Kind::kRangeIntensity) data += number(static_cast<std::uint32_t>(i), 3);
  }
  std::string text = scan_text(stream_echo_, counter(begin), data);
  if (corrupt_scans > 0) {
    --corrupt_scans;
    text[100] = static_cast<char>(text[100] ^ 1);
  }
  measured.push_back(begin);
  line_.send_at(when, text);
}

}  // namespace topo::hokuyo::testing_scip
