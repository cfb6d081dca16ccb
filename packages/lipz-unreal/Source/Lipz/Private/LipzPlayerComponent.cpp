#include "LipzPlayerComponent.h"

#include "Components/AudioComponent.h"
#include "Components/SkeletalMeshComponent.h"
#include "GameFramework/Actor.h"
#include "HAL/PlatformTime.h"
#include "LipzAudioClock.h"
#include "LipzBank.h"
#include "LipzDialogue.h"
#include "LipzLog.h"
#include "LipzMorphTargets.h"
#include "LipzPlayback.h"
#include "LipzWeights.h"
#include "Sound/SoundWave.h"

ULipzPlayerComponent::ULipzPlayerComponent()
	: Playback(MakeShared<FLipzPlayback>())
	, AudioClock(MakeShared<FLipzAudioClock>())
	, Weights(MakeShared<FLipzWeights>())
	, FaceTargets(MakeShared<FLipzMorphTargets>())
{
	PrimaryComponentTick.bCanEverTick = true;
	PrimaryComponentTick.bStartWithTickEnabled = false;
	// So that the mouth rests while the game is paused.
	PrimaryComponentTick.bTickEvenWhenPaused = true;
}

bool ULipzPlayerComponent::Play(const FString& Key)
{
	return Start(Key, EClock::Own);
}

bool ULipzPlayerComponent::PlayWithSound(const FString& Key, USoundBase* Sound)
{
	return Start(Key, EClock::Audio) && PlayAudio(Sound);
}

bool ULipzPlayerComponent::Begin(const FString& Key)
{
	return Start(Key, EClock::Yours);
}

bool ULipzPlayerComponent::Start(const FString& Key, EClock NewClock)
{
	Stop();
	if (bIsPlaying)
	{
		return false; // one of the last events has started a different clip
	}
	PlayingBank = Bank;
	const TSharedPtr<FLipzDialogue> Dialogue = GetDialogue();
	lipz_clip Clip;
	if (!Dialogue.IsValid() || !Dialogue->FindClip(Key, Clip))
	{
		UE_LOG(LogLipz, Warning, TEXT("%s: the bank has no clip \"%s\""), *GetPathName(), *Key);
		return false;
	}
	if (!Playback->Start(*Dialogue, Clip, Speaker))
	{
		UE_LOG(LogLipz, Warning, TEXT("%s: the clip \"%s\" has no frame rate"), *GetPathName(), *Key);
		return false;
	}
	Playback->SetLeadAndHold(*Dialogue, Clip, LeadFrames, bHoldConsonants);
	LineNumber++;
	PlayingKey = Key;
	Clock = NewClock;
	OwnSeconds = 0.0;
	ShownSegment = -1;
	bIsPlaying = true;
	bIsPaused = false;
	BeginFace();
	SetComponentTickEnabled(Clock != EClock::Yours);
	return true;
}

bool ULipzPlayerComponent::PlayAudio(USoundBase* Sound)
{
	PlayingAudio = AudioComponent;
	if (PlayingAudio == nullptr && GetOwner() != nullptr)
	{
		PlayingAudio = GetOwner()->FindComponentByClass<UAudioComponent>();
	}
	if (PlayingAudio == nullptr)
	{
		UE_LOG(LogLipz, Warning, TEXT("%s: the actor has no audio component, so no recording plays"), *GetPathName());
		Clock = EClock::Own;
		return true;
	}
	if (Sound != nullptr)
	{
		PlayingAudio->SetSound(Sound);
	}
	PlayingSound = PlayingAudio->Sound;
	// Unreal reports percentages only to delegates that are bound before the start.
	PlayingAudio->OnAudioPlaybackPercentNative.AddUObject(this, &ULipzPlayerComponent::HandlePlaybackPercent);
	AudioClock->Restart(0.0, FPlatformTime::Seconds());
	PlayingAudio->Play();
	if (!PlayingAudio->IsPlaying())
	{
		Clock = EClock::Own; // without audio device or sound, such as on a server
	}
	return true;
}

void ULipzPlayerComponent::HandlePlaybackPercent(const UAudioComponent* Component, const USoundWave* Wave, const float Fraction)
{
	const USoundWave* Expected = Cast<USoundWave>(PlayingSound.Get());
	if (Component == PlayingAudio && Wave != nullptr && (Expected == nullptr || Expected == Wave))
	{
		AudioClock->Report(Fraction, Wave->GetDuration(), Wave->IsLooping(), FPlatformTime::Seconds());
	}
}

void ULipzPlayerComponent::TickComponent(float DeltaTime, ELevelTick TickType, FActorComponentTickFunction* ThisTickFunction)
{
	Super::TickComponent(DeltaTime, TickType, ThisTickFunction);
	if (!bIsPlaying || Clock == EClock::Yours)
	{
		return;
	}
	const bool bGameIsPaused = TickType == LEVELTICK_PauseTick;
	if (Clock == EClock::Audio)
	{
		TickAudio(bGameIsPaused);
		return;
	}
	if (bIsPaused || bGameIsPaused)
	{
		Rest();
		return;
	}
	const double Seconds = OwnSeconds;
	OwnSeconds += static_cast<double>(DeltaTime);
	Move(Seconds);
}

void ULipzPlayerComponent::TickAudio(bool bGameIsPaused)
{
	if (!IsValid(PlayingAudio.Get()) || PlayingAudio->Sound != PlayingSound)
	{
		CutOff(); // the component was destroyed, or plays something else
		return;
	}
	const EAudioComponentPlayState State = PlayingAudio->GetPlayState();
	if (State == EAudioComponentPlayState::Stopped)
	{
		Finish();
		return;
	}
	if (bIsPaused || State == EAudioComponentPlayState::Paused || (bGameIsPaused && !PlayingAudio->bIsUISound))
	{
		Rest();
		return;
	}
	if (!AudioClock->HasReport())
	{
		return;
	}
	const TSharedPtr<FLipzDialogue> Dialogue = GetDialogue();
	const double Seconds = AudioClock->GetSeconds();
	for (int32 Loops = AudioClock->TakeLoops(); Dialogue.IsValid() && Loops > 0; Loops--)
	{
		Playback->LoopTo(*Dialogue, lipz_time_seconds(Seconds));
	}
	ShowAt(Seconds);
}

void ULipzPlayerComponent::AdvanceTo(float Seconds)
{
	if (bIsPlaying && Clock == EClock::Yours)
	{
		Move(static_cast<double>(Seconds));
	}
}

void ULipzPlayerComponent::Move(double Seconds)
{
	if (ShowAt(Seconds) && Playback->IsOver())
	{
		Finish();
	}
}

void ULipzPlayerComponent::Stop()
{
	if (bIsPlaying)
	{
		CutOff();
	}
}

void ULipzPlayerComponent::SetPaused(bool bPause)
{
	bIsPaused = bIsPlaying && bPause;
	if (bIsPlaying && PlayingAudio != nullptr)
	{
		PlayingAudio->SetPaused(bPause);
	}
	if (bIsPaused)
	{
		Rest();
	}
}

void ULipzPlayerComponent::Seek(float Seconds)
{
	const TSharedPtr<FLipzDialogue> Dialogue = GetDialogue();
	if (!bIsPlaying || !Dialogue.IsValid())
	{
		return;
	}
	OwnSeconds = static_cast<double>(Seconds);
	Playback->Seek(*Dialogue, lipz_time_seconds(OwnSeconds));
	if (Clock == EClock::Audio)
	{
		AudioClock->Restart(OwnSeconds, FPlatformTime::Seconds());
		PlayingAudio->Play(Seconds);
		PlayingAudio->SetPaused(bIsPaused);
	}
}

bool ULipzPlayerComponent::CutOff()
{
	const uint32 Line = LineNumber;
	if (const TSharedPtr<FLipzDialogue> Dialogue = GetDialogue())
	{
		Playback->Finish(*Dialogue);
		if (!HandleEvents())
		{
			return false;
		}
	}
	Forget();
	SetSubtitle(FText());
	return LineNumber == Line + 1;
}

void ULipzPlayerComponent::Finish()
{
	if (CutOff())
	{
		OnFinished.Broadcast();
	}
}

void ULipzPlayerComponent::Forget()
{
	LineNumber++;
	bIsPlaying = false;
	bIsPaused = false;
	ShownSegment = -1;
	SetComponentTickEnabled(false);
	if (IsValid(PlayingAudio.Get()))
	{
		PlayingAudio->OnAudioPlaybackPercentNative.RemoveAll(this);
		if (PlayingAudio->Sound == PlayingSound && PlayingAudio->IsPlaying())
		{
			PlayingAudio->Stop();
		}
	}
	PlayingAudio = nullptr;
	PlayingSound = nullptr;
	Rest();
}

void ULipzPlayerComponent::EndPlay(const EEndPlayReason::Type EndPlayReason)
{
	if (bIsPlaying)
	{
		Forget();
	}
	Super::EndPlay(EndPlayReason);
}

TSharedPtr<FLipzDialogue> ULipzPlayerComponent::GetDialogue() const
{
	return PlayingBank != nullptr ? PlayingBank->GetDialogue() : nullptr;
}
