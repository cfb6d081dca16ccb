#pragma once

#include "CoreMinimal.h"

#include "LipzEvent.generated.h"

/** What a character does in an event. The numbers are those of lipz.h. */
UENUM(BlueprintType)
enum class ELipzVerb : uint8
{
	/** The event string has a different syntax, such as a script: see Text. */
	Other = 0,
	/** An emotion, which lasts until changed. */
	Feels = 1,
	/** A glance at a character or a prop. */
	Sees = 2,
	/** A stare, until StopsStaring. */
	Stares = 3,
	StopsStaring = 4,
	/** Points at a character or a prop, until StopsPointing. */
	Points = 5,
	StopsPointing = 6,
	/** An action of the game. */
	Does = 7,
	/** A nod, with a strength. */
	Nods = 8,
	/** A shake of the head, with a strength. */
	Shakes = 9,
	/** A breath, with a strength. */
	Breathes = 10,
	Blinks = 11,
	LooksAway = 12
};

/** One event of a clip: `[character] verb object`. */
USTRUCT(BlueprintType)
struct LIPZ_API FLipzEvent
{
	GENERATED_BODY()

	/** The character, as spelled in the Lipz file; the speaker of the player in events without a character. */
	UPROPERTY(BlueprintReadOnly, Category = "Lipz")
	FString Character;

	UPROPERTY(BlueprintReadOnly, Category = "Lipz")
	ELipzVerb Verb = ELipzVerb::Other;

	/** The emotion, target or action; empty if the verb has no object. */
	UPROPERTY(BlueprintReadOnly, Category = "Lipz")
	FString Object;

	/** The strength of a gesture, from 0 to 10; 1 if the event does not state it. */
	UPROPERTY(BlueprintReadOnly, Category = "Lipz")
	float Strength = 1.0f;

	/** The whole event string, if Verb is Other; otherwise empty. */
	UPROPERTY(BlueprintReadOnly, Category = "Lipz")
	FString Text;
};
