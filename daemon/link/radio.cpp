// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/link/radio.hpp"

#include <datagram.h>
#include <dds/dds.h>
#include <fmt/format.h>
#include <sys/random.h>

#include <cstring>
#include <thread>

#include "daemon/link/dds_log.hpp"
#include "daemon/link/radio_filter.hpp"
#include "daemon/link/sender_numbers.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

using Shared = Radio::Shared;

constexpr const char* kTopic = "topometric/datagram";
/// The reader looks this often whether it is to end.
constexpr dds_duration_t kLook = DDS_MSECS(200);
constexpr std::int32_t kReaderDepth = 512;  // samples that wait while the reading thread does not run
constexpr std::size_t kTakenAtOnce = 32;

struct FreeQos {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, FreeQos>;

Qos datagram_qos() {
  Qos qos(dds_create_qos());
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, kReaderDepth);
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  return qos;
}

/// A publisher's or subscriber's.
Qos partition_qos(const std::string& partition) {
  Qos qos(dds_create_qos());
  dds_qset_partition1(qos.get(), partition.c_str());
  return qos;
}

struct Entities {
  dds_entity_t participant = 0, reader = 0, writer = 0;
};

/// An entity, or what DDS said.
struct Maker {
  std::string fault;
  dds_entity_t made(dds_entity_t entity, const char* what) {
    if (entity < 0 && fault.empty()) fault = fmt::format("{}: {}", what, dds_strretcode(entity));
    return entity;
  }
};

std::string make_entities(const RadioPlan& plan, Entities& made) {
  const std::string xml = cyclone_config(plan, TOPO_CYCLONE_PLUGINS);
  Maker maker;
  maker.made(dds_create_domain(plan.domain, xml.c_str()), "domain");
  if (!maker.fault.empty()) return maker.fault;
  made.participant = maker.made(dds_create_participant(plan.domain, nullptr, nullptr), "participant");
  if (!maker.fault.empty()) return maker.fault;
  const Qos qos = datagram_qos();
  const dds_entity_t topic = maker.made(
      dds_create_topic(made.participant, &topometric_Datagram_desc, kTopic, qos.get(), nullptr), "topic");
  if (!maker.fault.empty()) return maker.fault;
  const Qos all = partition_qos("*"), own = partition_qos(robot_partition(plan.robot));
  const dds_entity_t hears =
      maker.made(dds_create_subscriber(made.participant, all.get(), nullptr), "subscriber");
  const dds_entity_t speaks =
      maker.made(dds_create_publisher(made.participant, own.get(), nullptr), "publisher");
  if (!maker.fault.empty()) return maker.fault;
  made.reader = maker.made(dds_create_reader(hears, topic, qos.get(), nullptr), "reader");
  made.writer = maker.made(dds_create_writer(speaks, topic, qos.get(), nullptr), "writer");
  if (made.reader == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY ||
      made.writer == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY)
    maker.fault += fmt::format(
        "; expected permissions to write as robot {}, which \"topometric-team add {}\" makes anew",
        plan.robot, plan.robot);
  return maker.fault;
}

void count(Shared& shared, LinkDrop drop) {
  shared.dropped[static_cast<std::size_t>(drop)].fetch_add(1, std::memory_order_relaxed);
}

void hand_in(Shared& shared, RadioFilter& filter, const topometric_Datagram& sample, std::uint16_t writer) {
  const RadioHead head{sample.version, sample.robot, sample.team, sample.run, sample.number, writer};
  if (const auto drop = filter.refuse(head, sample.content._length)) return count(shared, *drop);
  RadioSlot* slot = shared.in.try_acquire();
  if (slot == nullptr) return count(shared, LinkDrop::kDaemonFull);
  slot->size = static_cast<std::uint16_t>(sample.content._length);
  slot->robot = sample.robot;
  std::memcpy(slot->bytes.data(), sample.content._buffer, slot->size);
  shared.in.commit();
}

/// Takes what is there; false: nothing was.
bool take_samples(Shared& shared, RadioFilter& filter, SenderNumbers& numbers, dds_entity_t reader) {
  std::array<void*, kTakenAtOnce> samples{};
  std::array<dds_sample_info_t, kTakenAtOnce> infos{};
  const dds_return_t taken = dds_take(reader, samples.data(), infos.data(), kTakenAtOnce, kTakenAtOnce);
  if (taken <= 0) return false;
  for (std::size_t i = 0; i < static_cast<std::size_t>(taken); ++i) {
    if (infos[i].valid_data)
      hand_in(shared, filter, *static_cast<const topometric_Datagram*>(samples[i]),
              numbers.of(infos[i].publication_handle));
  }
  dds_return_loan(reader, samples.data(), taken);
  shared.arrived.post();
  return true;
}

void read_until_stop(Shared& shared, RadioFilter filter, dds_entity_t participant, dds_entity_t reader) {
  const dds_entity_t waiting = dds_create_waitset(participant);
  const dds_entity_t anything = dds_create_readcondition(reader, DDS_ANY_STATE);
  dds_waitset_attach(waiting, anything, 0);
  SenderNumbers numbers(reader);
  while (!shared.stop.load(std::memory_order_acquire)) {
    dds_waitset_wait(waiting, nullptr, 0, kLook);
    while (take_samples(shared, filter, numbers, reader)) {
    }
    dds_subscription_matched_status_t matched{};
    if (dds_get_subscription_matched_status(reader, &matched) == DDS_RETCODE_OK)
      shared.mates.store(static_cast<std::uint16_t>(matched.current_count), std::memory_order_relaxed);
  }
  shared.reader_ended.store(true, std::memory_order_release);
}

/// What is written again and again, and the bytes that its sequence points to.
struct Outgoing {
  topometric_Datagram sample{};
  std::array<std::uint8_t, kDatagramMax_bytes> content{};
};

void write_one(Shared& shared, dds_entity_t writer, Outgoing& out, const RadioSlot& slot) {
  std::memcpy(out.content.data(), slot.bytes.data(), slot.size);
  out.sample.content._buffer = out.content.data();
  out.sample.content._length = slot.size;
  ++out.sample.number;
  shared.busy_since_ns.store(io::monotonic_now().time_since_epoch().count(), std::memory_order_relaxed);
  const dds_return_t written = dds_write(writer, &out.sample);
  shared.busy_since_ns.store(0, std::memory_order_relaxed);
  if (written != DDS_RETCODE_OK) return count(shared, LinkDrop::kWriteFailed);
  shared.sent.fetch_add(1, std::memory_order_relaxed);
  shared.sent_bytes.fetch_add(slot.size, std::memory_order_relaxed);
}

void write_until_stop(Shared& shared, dds_entity_t writer, const LinkIdentity& own, std::uint64_t run) {
  Outgoing out;
  out.sample.version = kRadioVersion;
  out.sample.robot = own.robot;
  out.sample.team = own.team;
  out.sample.run = run;
  out.sample.content._maximum = kDatagramMax_bytes;
  while (!shared.stop.load(std::memory_order_acquire)) {
    shared.to_send.wait(std::chrono::milliseconds(200));
    while (const RadioSlot* slot = shared.out.front()) {
      if (shared.stop.load(std::memory_order_acquire)) return;
      write_one(shared, writer, out, *slot);
      shared.out.pop();
    }
  }
}

std::uint64_t draw_run() {
  std::uint64_t run = 0;
  if (::getrandom(&run, sizeof run, 0) != sizeof run || run == 0)
    run = static_cast<std::uint64_t>(io::monotonic_now().time_since_epoch().count()) | 1U;
  return run;
}

void run_radio(const std::shared_ptr<Shared>& shared, const RadioPlan& plan, const LinkIdentity& own) {
  Entities made;
  shared->busy_since_ns.store(io::monotonic_now().time_since_epoch().count(), std::memory_order_relaxed);
  if (std::string fault = make_entities(plan, made); !fault.empty()) {
    dds_delete(DDS_CYCLONEDDS_HANDLE);  // the domain, which a second trial makes again
    shared->failure = std::move(fault);
    shared->failed.store(true, std::memory_order_release);
    shared->arrived.post();
    return;
  }
  shared->busy_since_ns.store(0, std::memory_order_relaxed);
  const std::uint64_t run = draw_run();
  std::thread([shared, own, run, made] {
    read_until_stop(*shared, RadioFilter(own, run), made.participant, made.reader);
  }).detach();
  shared->up.store(true, std::memory_order_release);
  shared->arrived.post();
  write_until_stop(*shared, made.writer, own, run);
  while (!shared->reader_ended.load(std::memory_order_acquire))
    io::sleep_until(io::monotonic_now() + std::chrono::milliseconds(5));
  dds_delete(DDS_CYCLONEDDS_HANDLE);
  shared->ended.store(true, std::memory_order_release);
  shared->arrived.post();
}

}  // namespace

Radio::Radio(RadioPlan plan, const LinkIdentity& own)
    : plan_(std::move(plan)), own_(own), shared_(std::make_shared<Shared>()) {}

void Radio::start() {
  log_of_dds([shared = shared_] { count(*shared, LinkDrop::kNotTrusted); });
  std::thread([shared = shared_, plan = plan_, own = own_] { run_radio(shared, plan, own); }).detach();
}

bool Radio::end(types::Duration patience) {
  shared_->stop.store(true, std::memory_order_release);
  shared_->to_send.post();
  const types::Stamp deadline = io::monotonic_now() + patience;
  while (!shared_->ended.load(std::memory_order_acquire) &&
         !shared_->failed.load(std::memory_order_acquire)) {
    const types::Duration left = deadline - io::monotonic_now();
    if (left <= types::Duration::zero()) return false;
    shared_->arrived.wait(left);
  }
  return true;
}

bool Radio::send(std::span<const std::byte> datagram) {
  RadioSlot* slot = shared_->out.try_acquire();
  if (slot == nullptr) return false;
  slot->size = static_cast<std::uint16_t>(datagram.size());
  std::memcpy(slot->bytes.data(), datagram.data(), datagram.size());
  shared_->out.commit();
  shared_->to_send.post();
  return true;
}

types::Duration Radio::busy(types::Stamp now) const {
  const std::int64_t since = shared_->busy_since_ns.load(std::memory_order_relaxed);
  return since == 0 ? types::Duration::zero() : now.time_since_epoch() - types::Duration(since);
}

}  // namespace topo::daemon
