#pragma once

// An actor with a player, an audio component and a face, and what the player has reported.

#include "Animation/MorphTarget.h"
#include "Components/AudioComponent.h"
#include "Components/SkeletalMeshComponent.h"
#include "CoreMinimal.h"
#include "Engine/SkeletalMesh.h"
#include "GameFramework/Actor.h"
#include "HAL/PlatformTime.h"
#include "LipzBank.h"
#include "LipzPlayerComponent.h"
#include "Sound/SoundWave.h"

#include <string>
#include <vector>

/** The repository, from the command line. */
extern std::string Root;

/** Counts a check, and prints it if it fails. */
void Expect(bool bIsTrue, const std::string& Problem, const char* File, int Line);
#define EXPECT(Condition) Expect(Condition, #Condition, __FILE__, __LINE__)

/** Counts a comparison, and prints both values if they differ. */
void ExpectSame(const std::string& Actual, const std::string& Expected, const char* File, int Line);
#define EXPECT_SAME(Actual, Expected) ExpectSame(Actual, Expected, __FILE__, __LINE__)

FString ToFString(const std::string& Utf8);
TArray<uint8> ReadFixture(const std::string& Name);
ULipzBank* OpenFixture(const std::string& Name);

/** `mara feels neutral`, or the text of an event in a different syntax. */
std::string Words(const FLipzEvent& Event);

class FStage
{
public:
	/** A face with morph targets of these names. */
	explicit FStage(const std::string& Bank, const std::vector<std::string>& Shapes = {});

	/** Ticks as the engine does, if the tick is enabled. */
	void Tick(double Seconds, ELevelTick Type = LEVELTICK_All);

	/** What was reported since the last call: `mara feels neutral; "Guten Abend, Otto."; finished`. */
	std::string Take();

	/** The weight of a morph target. */
	float Shape(const std::string& Name) const;

	AActor* Actor;
	ULipzPlayerComponent* Player;
	UAudioComponent* Audio;
	USkeletalMeshComponent* Mesh;
	USoundWave* Sound;

private:
	std::string Reported;
	void Report(const std::string& Words);
};

void TestBanks();
void TestDamage();
void TestCases();
void TestPlayers();
void TestAudio();
void TestHandlers();
void TestFaces();
void TestImports();
void TestGuide();
void TestFrames();
