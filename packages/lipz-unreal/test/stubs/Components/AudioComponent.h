#pragma once

#include "Components/ActorComponent.h"

class USoundBase;
class USoundWave;

enum class EAudioComponentPlayState : uint8 { Playing, Stopped, Paused, FadingIn, FadingOut, Count };

class UAudioComponent : public UActorComponent
{
	STUB_CLASS(UAudioComponent, UActorComponent)

	void SetSound(USoundBase* NewSound);
	void Play(float StartTime = 0.0f);
	void Stop() { StubState = EAudioComponentPlayState::Stopped; }
	void SetPaused(bool bPause);
	bool IsPlaying() const { return StubState != EAudioComponentPlayState::Stopped; }
	EAudioComponentPlayState GetPlayState() const { return StubState; }

	/** Reports a percentage, as Unreal does if a delegate was bound when the sound started. */
	void StubReport(const USoundWave* Wave, float Fraction);

	TObjectPtr<USoundBase> Sound;
	uint8 bIsUISound : 1 = 0;
	TStubDelegate<const UAudioComponent*, const USoundWave*, const float> OnAudioPlaybackPercentNative;

	EAudioComponentPlayState StubState = EAudioComponentPlayState::Stopped;
	float StubStart = 0.0f;
	bool bStubReports = false;
	bool bStubHasDevice = true;
};
