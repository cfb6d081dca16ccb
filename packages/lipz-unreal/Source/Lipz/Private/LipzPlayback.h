#pragma once

#include "CoreMinimal.h"

#include "LipzDialogue.h"
#include "LipzEvent.h"

/**
 * The position in a clip, and the events that are due. It keeps neither the dialogue nor pointers into it, so the bank
 * can be replaced while a clip plays.
 */
class FLipzPlayback
{
public:
	/** Starts a clip. Returns false if it has no frame rate. */
	bool Start(const FLipzDialogue& Dialogue, const lipz_clip& Clip, const FString& InSpeaker);

	/** Sets the frames by which visemes are ahead of the audio, and whether consonants last long enough to be read. */
	void SetLeadAndHold(const FLipzDialogue& Dialogue, const lipz_clip& Clip, int32 LeadFrames, bool bHoldConsonants);

	void AdvanceTo(const FLipzDialogue& Dialogue, lipz_time Time);
	void LoopTo(const FLipzDialogue& Dialogue, lipz_time Time);
	void Seek(const FLipzDialogue& Dialogue, lipz_time Time);

	/** Makes all remaining events due. */
	void Finish(const FLipzDialogue& Dialogue);

	/** Takes the next due event. Events that were not taken remain due after the next move. */
	bool TakeEvent(const FLipzDialogue& Dialogue, FLipzEvent& OutEvent);

	bool FindClip(const FLipzDialogue& Dialogue, lipz_clip& OutClip) const;

	/** Writes the segment of the subtitle to show, if there is one. */
	bool FindSegment(const FLipzDialogue& Dialogue, lipz_segment& OutSegment) const;

	/** The code of the viseme to show. */
	uint8 GetViseme(const FLipzDialogue& Dialogue) const;

	/** The speaker, whose face is shown. The pointer is valid until the next start. */
	lipz_who GetSpeaker() const;

	bool IsOver() const { return Cursor.frame == LIPZ_OVER; }

private:
	void CollectDue(const FLipzDialogue& Dialogue);
	bool TakeEventOf(const FLipzDialogue& Dialogue, const lipz_segment& Segment, FLipzEvent& OutEvent);

	lipz_cursor Cursor = {};

	FString Speaker;
	TArray<ANSICHAR> SpeakerUtf8;

	/** Segments whose events are due, in their order, and the next event of the first one. */
	TArray<lipz_segment> Due;
	int32 NextDue = 0;
	uint32 NextEvent = 0;
};
