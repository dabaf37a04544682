#pragma once

#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "cloth_sim/ClothState.h"
#include "cloth_sim/ClothStats.h"

#include "listener.h"

namespace cloth
{

/// Balances the ticks of /cloth_node that were due against those that came and those that were counted as overruns.
/// The node keeps one rate (Hz) and a real-time factor of 1.
class TickLedger
{
public:
  explicit TickLedger(double rate) : rate_(rate)
  {
  }

  const Listener<cloth_sim::ClothState>& states() const
  {
    return state_;
  }
  Listener<cloth_sim::ClothState>& states()
  {
    return state_;
  }
  Listener<cloth_sim::ClothStats>& stats()
  {
    return stats_;
  }

  /// Opens the account: from now on no tick may be lost.
  void open()
  {
    opened_ = entry();
    ASSERT_TRUE(opened_);
  }

  /// Expects that every tick since then came or was counted.
  void expect_balance()
  {
    const std::optional<Entry> now = entry();
    ASSERT_TRUE(opened_ && now);
    const std::int64_t due = std::llround((now->stamp - opened_->stamp).toSec() * rate_);
    const std::int64_t came = std::llround((now->sim_time - opened_->sim_time) * rate_);
    EXPECT_EQ(due - came, static_cast<std::int64_t>(now->overruns) - opened_->overruns)
        << due << " ticks were due, " << came << " came";
  }

  void expect_finite_states() const
  {
    for (const cloth_sim::ClothState& state : state_.all())
    {
      for (size_t i = 0; i < state.positions.size(); ++i)
      {
        ASSERT_TRUE(std::isfinite(state.positions[i]) && std::isfinite(state.velocities[i])) << state.sim_time << " s";
      }
    }
  }

private:
  /// A state, and the overruns until it was published.
  struct Entry
  {
    ros::Time stamp;
    double sim_time = 0.0;
    std::uint32_t overruns = 0;
  };

  /// One between two stats that tell of the same overruns.
  std::optional<Entry> entry()
  {
    if (!stats_.wait_for_more(1))
    {
      return std::nullopt;
    }
    cloth_sim::ClothStats before = stats_.last();
    const bool is_quiet = stats_.wait_for_one([&](const cloth_sim::ClothStats& stats) {
      const bool same = stats.overruns == before.overruns && stats.sim_time > before.sim_time;
      before = same ? before : stats;
      return same;
    });
    const double end = stats_.last().sim_time;
    const auto reached = [&] { return !state_.all().empty() && state_.last().sim_time >= end; };
    if (!is_quiet || !wait_until(reached))
    {
      return std::nullopt;
    }
    for (const cloth_sim::ClothState& state : state_.all())
    {
      if (state.sim_time > before.sim_time && state.sim_time <= end)
      {
        return Entry{ state.header.stamp, state.sim_time, before.overruns };
      }
    }
    return std::nullopt;
  }

  double rate_;
  Listener<cloth_sim::ClothState> state_{ "/cloth_node/state" };
  Listener<cloth_sim::ClothStats> stats_{ "/cloth_node/stats" };
  std::optional<Entry> opened_;
};

}  // namespace cloth
