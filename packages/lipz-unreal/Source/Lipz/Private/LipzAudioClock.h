#pragma once

#include "CoreMinimal.h"

/**
 * The position of a recording, from the playback percentages that an audio component reports. They are fractions from
 * 0 to 1. While a recording loops, they go on beyond 1, or start again at 0.
 */
class FLipzAudioClock
{
public:
	/** Starts at a position, at the time Now of the system in seconds. */
	void Restart(double InSeconds, double Now);

	/**
	 * Takes a fraction of a recording with this duration in seconds. Ignores late reports of the previous recording,
	 * which arrive after a restart.
	 */
	void Report(double Fraction, double Duration, bool bLooping, double Now);

	/** Takes the number of times that the recording has started again since the last call. */
	int32 TakeLoops();

	/** The position in the recording. */
	double GetSeconds() const { return Seconds; }

	/** Whether a position was reported since the start. */
	bool HasReport() const { return bHasReport; }

private:
	double Seconds = 0.0;
	double LastFraction = 0.0;
	double StartedAt = 0.0;
	int32 Loops = 0;
	bool bHasReport = false;
};
