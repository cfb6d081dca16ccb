#include "LipzAudioClock.h"

void FLipzAudioClock::Restart(double InSeconds, double Now)
{
	*this = FLipzAudioClock();
	Seconds = InSeconds;
	StartedAt = Now;
}

void FLipzAudioClock::Report(double Fraction, double Duration, bool bLooping, double Now)
{
	if (!FMath::IsFinite(Fraction) || !FMath::IsFinite(Duration) || Fraction < 0.0 || Duration <= 0.0)
	{
		return;
	}
	// A recording does not play at more than four times its speed. Unreal rounds to buffers of less than half a second.
	if (!bHasReport && Fraction * Duration - Seconds > 4.0 * (Now - StartedAt) + 0.5)
	{
		return;
	}
	double Position = Fraction;
	if (bLooping)
	{
		const double Whole = FMath::FloorToDouble(Fraction);
		const double LastWhole = FMath::FloorToDouble(LastFraction);
		Position = Fraction - Whole;
		if (bHasReport && Fraction > LastFraction)
		{
			Loops += static_cast<int32>(FMath::Min(Whole - LastWhole, 1000.0));
		}
		else if (bHasReport && LastFraction - Fraction > 0.5)
		{
			Loops++;
		}
	}
	LastFraction = Fraction;
	Seconds = Position * Duration;
	bHasReport = true;
}

int32 FLipzAudioClock::TakeLoops()
{
	const int32 Taken = Loops;
	Loops = 0;
	return Taken;
}
