//! The time of a line: that of the game, of a recording, or your own.

use bevy::reflect::Reflect;
#[cfg(feature = "audio")]
pub(crate) use recording::listen;
use std::time::Duration;

/// The source of a player's time.
#[derive(Reflect, Clone, Copy, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub enum LipzClock {
    /// The time of the game, from the rendered frame in which the line starts. `Time<Virtual>` pauses it and sets its
    /// speed.
    #[default]
    Game,
    /// The position of the recording in the `AudioSink` or `SpatialAudioSink` of the same entity.
    ///
    /// The line waits for the sink. It ends with the recording, and the mouth rests while the sink is paused.
    #[cfg(feature = "audio")]
    Recording,
    /// Your own, such as the position in FMOD or Kira: call [`LipzPlayer::set_time`](crate::LipzPlayer::set_time) in
    /// each rendered frame, before [`LipzSystems::Play`](crate::LipzSystems::Play).
    Manual,
}

/// The reading of a clock in a rendered frame.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum ClockReading {
    /// This much later than in the last rendered frame.
    Later(Duration),
    /// At this time. The mouth rests if the clock is paused.
    At { time: Duration, is_paused: bool },
    /// After the end of the recording.
    #[cfg_attr(not(feature = "audio"), expect(dead_code, reason = "only recordings have an end"))]
    Ended,
    /// The clock has not started.
    Waiting,
}

#[cfg(feature = "audio")]
mod recording {
    use super::{ClockReading, LipzClock};
    use crate::LipzPlayer;
    use bevy::audio::{AudioSink, AudioSinkPlayback, SpatialAudioSink};
    use bevy::ecs::change_detection::DetectChangesMut;
    use bevy::ecs::system::Query;

    /// Reads the positions of the recordings.
    pub(crate) fn listen(mut players: Query<(&mut LipzPlayer, Option<&AudioSink>, Option<&SpatialAudioSink>)>) {
        for (mut player, sink, spatial) in &mut players {
            if player.clock != LipzClock::Recording {
                continue;
            }
            let reading = sink.map(position).or_else(|| spatial.map(position));
            player.bypass_change_detection().hear(reading);
        }
    }

    fn position(sink: &impl AudioSinkPlayback) -> ClockReading {
        if sink.empty() {
            return ClockReading::Ended;
        }
        let (position, speed) = (sink.position(), sink.speed());
        // A recording at its own speed is not rounded.
        let time = if speed == 1.0 { position } else { position.mul_f32(speed.max(0.0)) };
        ClockReading::At { time, is_paused: sink.is_paused() }
    }
}
