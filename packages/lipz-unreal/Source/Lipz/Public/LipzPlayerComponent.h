#pragma once

#include "Components/ActorComponent.h"
#include "CoreMinimal.h"
#include "LipzEvent.h"

#include "LipzPlayerComponent.generated.h"

class FLipzAudioClock;
class FLipzDialogue;
class FLipzMorphTargets;
class FLipzPlayback;
class FLipzWeights;
class UAudioComponent;
class ULipzBank;
class USkeletalMeshComponent;
class USoundBase;
class USoundWave;
class UStringTable;

/** Receives an event of the clip. */
DECLARE_DYNAMIC_MULTICAST_DELEGATE_OneParam(FLipzEventSignature, const FLipzEvent&, Event);

/** Receives the subtitle to show; an empty text to hide it. */
DECLARE_DYNAMIC_MULTICAST_DELEGATE_OneParam(FLipzSubtitleSignature, const FText&, Subtitle);

/** Called after a clip was played to its end. */
DECLARE_DYNAMIC_MULTICAST_DELEGATE(FLipzFinishedSignature);

/**
 * Plays clips of a bank: reports events and subtitles, and moves the morph targets of a face. It follows an audio
 * component, or a clock of its own, or your clock.
 */
UCLASS(ClassGroup = (Lipz), meta = (BlueprintSpawnableComponent))
class LIPZ_API ULipzPlayerComponent : public UActorComponent
{
	GENERATED_BODY()

public:
	ULipzPlayerComponent();

	/** The bank with the clips. */
	UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = "Lipz")
	TObjectPtr<ULipzBank> Bank;

	/** The character who speaks, as spelled in the Lipz files. Events without a character belong to the speaker. */
	UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = "Lipz")
	FString Speaker;

	/** The rig of the bank ([rig] in lipz.toml), whose weights move morph targets of the same names. */
	UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = "Lipz|Face")
	FString Rig = TEXT("arkit");

	/** The morph targets for weights, visemes (A) or curves whose names differ from those of the morph targets. */
	UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = "Lipz|Face")
	TMap<FName, FName> MorphTargets;

	/** The mesh of the face. Empty: the mesh of the actor that has most of the morph targets. */
	UPROPERTY(BlueprintReadWrite, Category = "Lipz|Face")
	TObjectPtr<USkeletalMeshComponent> Face;

	/** The frames of the clip by which visemes are ahead of the audio. */
	UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = "Lipz|Face")
	int32 LeadFrames = 0;

	/** Shows consonants long enough to be read. */
	UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = "Lipz|Face")
	bool bHoldConsonants = true;

	/** The component that plays recordings. Empty: the first audio component of the actor. */
	UPROPERTY(BlueprintReadWrite, Category = "Lipz")
	TObjectPtr<UAudioComponent> AudioComponent;

	/** A string table (`lipz export texts unreal --by segment`), whose texts replace those of the bank. */
	UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = "Lipz|Subtitles")
	TObjectPtr<UStringTable> SubtitleTable;

	/** Called with each event, exactly once, however long a rendered frame takes. */
	UPROPERTY(BlueprintAssignable, Category = "Lipz")
	FLipzEventSignature OnEvent;

	/** Called with each new subtitle, and with an empty text at the end. */
	UPROPERTY(BlueprintAssignable, Category = "Lipz")
	FLipzSubtitleSignature OnSubtitle;

	/** Called after a clip was played to its end, but not after Stop. */
	UPROPERTY(BlueprintAssignable, Category = "Lipz")
	FLipzFinishedSignature OnFinished;

	/** Plays a clip without a recording. Returns false if it is missing or has no frame rate. */
	UFUNCTION(BlueprintCallable, Category = "Lipz")
	bool Play(const FString& Key);

	/** Plays a clip along with its recording. Null: the sound that the audio component has. */
	UFUNCTION(BlueprintCallable, Category = "Lipz")
	bool PlayWithSound(const FString& Key, USoundBase* Sound);

	/** Starts a clip for a clock of your own, such as that of Wwise: call AdvanceTo in each rendered frame. */
	UFUNCTION(BlueprintCallable, Category = "Lipz")
	bool Begin(const FString& Key);

	/** Shows the clip at a time of your clock. */
	UFUNCTION(BlueprintCallable, Category = "Lipz")
	void AdvanceTo(float Seconds);

	/** Cuts the clip off. The remaining events happen at once, so that lasting emotions take effect. */
	UFUNCTION(BlueprintCallable, Category = "Lipz")
	void Stop();

	/** Pauses the clip and its recording, with the mouth at rest, or resumes them. */
	UFUNCTION(BlueprintCallable, Category = "Lipz")
	void SetPaused(bool bPause);

	/** Jumps to a time. The events in between do not happen. */
	UFUNCTION(BlueprintCallable, Category = "Lipz")
	void Seek(float Seconds);

	/** Sets the language of subtitles, also while a clip plays: `de-de`. Empty: the language of the game. */
	UFUNCTION(BlueprintCallable, Category = "Lipz|Subtitles")
	void SetLocale(const FString& NewLocale);

	/** Whether a clip is playing or paused. */
	UFUNCTION(BlueprintPure, Category = "Lipz")
	bool IsPlaying() const { return bIsPlaying; }

	/** The subtitle that is shown. */
	UFUNCTION(BlueprintPure, Category = "Lipz|Subtitles")
	FText GetSubtitle() const { return Subtitle; }

	/** The code of the viseme that is shown, a single letter or digit; "-" at rest. */
	UFUNCTION(BlueprintPure, Category = "Lipz|Face")
	FString GetViseme() const;

	/** The weights by name, for Modify Curve in an animation blueprint. All are 0 at rest. */
	UFUNCTION(BlueprintPure, Category = "Lipz|Face")
	const TMap<FName, float>& GetWeights() const { return WeightsByName; }

	/** A weight of the rig, of a viseme or of a curve; 0 at rest or if it is missing. */
	UFUNCTION(BlueprintPure, Category = "Lipz|Face")
	float GetWeight(FName Name) const;

	virtual void TickComponent(float DeltaTime, ELevelTick TickType, FActorComponentTickFunction* ThisTickFunction) override;
	virtual void EndPlay(const EEndPlayReason::Type EndPlayReason) override;

private:
	enum class EClock : uint8
	{
		Yours,
		Own,
		Audio
	};

	bool Start(const FString& Key, EClock NewClock);
	bool PlayAudio(USoundBase* Sound);
	void HandlePlaybackPercent(const UAudioComponent* Component, const USoundWave* Wave, const float Fraction);
	void TickAudio(bool bGameIsPaused);
	void Move(double Seconds);

	/** Handles due events, and shows the clip. Returns false if a handler has ended it, or started the next one. */
	bool ShowAt(double Seconds);
	bool HandleEvents();
	void ShowSubtitle();
	void SetSubtitle(const FText& NewSubtitle);
	FText FindSubtitle(uint32 SegmentIndex) const;
	void BeginFace();
	void FindFace();
	void ShowFace(double Seconds);
	void Rest();
	void ApplyWeights();

	/** Ends the clip. Returns false if one of its last events has started the next one. */
	bool CutOff();
	void Finish();
	void Forget();

	/** The open bank of the clip that plays; null if there is none. */
	TSharedPtr<FLipzDialogue> GetDialogue() const;

	UPROPERTY(EditAnywhere, Category = "Lipz|Subtitles")
	FString Locale;

	/** The bank, the audio and the face of the clip that plays. */
	UPROPERTY(Transient)
	TObjectPtr<ULipzBank> PlayingBank;

	UPROPERTY(Transient)
	TObjectPtr<UAudioComponent> PlayingAudio;

	UPROPERTY(Transient)
	TObjectPtr<USoundBase> PlayingSound;

	UPROPERTY(Transient)
	TObjectPtr<USkeletalMeshComponent> PlayingFace;

	TSharedPtr<FLipzPlayback> Playback;
	TSharedPtr<FLipzAudioClock> AudioClock;
	TSharedPtr<FLipzWeights> Weights;
	TSharedPtr<FLipzMorphTargets> FaceTargets;
	TMap<FName, float> WeightsByName;
	FString PlayingKey;
	FText Subtitle;
	double OwnSeconds = 0.0;
	/** The segment of the subtitle; -1 without one. */
	int64 ShownSegment = -1;
	/** Changes with each start and each end. */
	uint32 LineNumber = 0;
	EClock Clock = EClock::Own;
	bool bIsPlaying = false;
	bool bIsPaused = false;
	bool bIsAtRest = true;
};
