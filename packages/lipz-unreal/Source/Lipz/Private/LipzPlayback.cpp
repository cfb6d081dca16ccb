#include "LipzPlayback.h"

#include "LipzStrings.h"

bool FLipzPlayback::Start(const FLipzDialogue& Dialogue, const lipz_clip& Clip, const FString& InSpeaker)
{
	lipz_cursor Started;
	if (lipz_cursor_new(Dialogue.Get(), &Clip, sizeof(Started), &Started) != LIPZ_OK)
	{
		return false;
	}
	const FTCHARToUTF8 Utf8(*InSpeaker);
	Cursor = Started;
	Speaker = InSpeaker;
	SpeakerUtf8.Reset();
	SpeakerUtf8.Append(Utf8.Get(), Utf8.Length());
	Due.Reset();
	NextDue = 0;
	NextEvent = 0;
	return true;
}

void FLipzPlayback::SetLeadAndHold(const FLipzDialogue& Dialogue, const lipz_clip& Clip, int32 LeadFrames, bool bHoldConsonants)
{
	uint64_t LeadMicros = 0;
	uint32 HoldFrames = 0;
	lipz_clip_start_of_frame_us(Dialogue.Get(), &Clip, static_cast<uint32>(FMath::Max(LeadFrames, 0)), &LeadMicros);
	lipz_clip_hold_frames(Dialogue.Get(), &Clip, 0, &HoldFrames);
	Cursor.lead_us = static_cast<uint32>(FMath::Min<uint64_t>(LeadMicros, MAX_uint32));
	Cursor.hold_frames = bHoldConsonants ? HoldFrames : 0;
}

void FLipzPlayback::AdvanceTo(const FLipzDialogue& Dialogue, lipz_time Time)
{
	lipz_cursor_advance(Dialogue.Get(), &Cursor, Time);
	CollectDue(Dialogue);
}

void FLipzPlayback::LoopTo(const FLipzDialogue& Dialogue, lipz_time Time)
{
	lipz_cursor_loop(Dialogue.Get(), &Cursor, Time);
	CollectDue(Dialogue);
}

void FLipzPlayback::Seek(const FLipzDialogue& Dialogue, lipz_time Time)
{
	lipz_cursor_seek(Dialogue.Get(), &Cursor, Time);
}

void FLipzPlayback::Finish(const FLipzDialogue& Dialogue)
{
	lipz_cursor_finish(Dialogue.Get(), &Cursor);
	CollectDue(Dialogue);
}

void FLipzPlayback::CollectDue(const FLipzDialogue& Dialogue)
{
	if (NextDue == Due.Num())
	{
		Due.Reset();
		NextDue = 0;
	}
	lipz_segment Segment;
	while (lipz_cursor_take_segment(Dialogue.Get(), &Cursor, &Segment) == LIPZ_OK)
	{
		Due.Add(Segment);
	}
}

bool FLipzPlayback::TakeEvent(const FLipzDialogue& Dialogue, FLipzEvent& OutEvent)
{
	for (; NextDue < Due.Num(); NextDue++, NextEvent = 0)
	{
		if (TakeEventOf(Dialogue, Due[NextDue], OutEvent))
		{
			return true;
		}
	}
	return false;
}

bool FLipzPlayback::TakeEventOf(const FLipzDialogue& Dialogue, const lipz_segment& Segment, FLipzEvent& OutEvent)
{
	lipz_event Event;
	while (lipz_segment_event(Dialogue.Get(), &Segment, NextEvent, &Event) == LIPZ_OK)
	{
		NextEvent++;
		if (Event.verb < LIPZ_FEELS || Event.verb > LIPZ_LOOKS_AWAY)
		{
			continue; // of a later version
		}
		OutEvent = FLipzEvent();
		OutEvent.Character = Event.character.bank == LIPZ_NO_NAME ? Speaker : LipzStrings::ToFString(Event.character.name);
		OutEvent.Verb = static_cast<ELipzVerb>(Event.verb);
		OutEvent.Object = LipzStrings::ToFString(Event.object.name);
		if (Event.strength_thousandths != LIPZ_NO_STRENGTH)
		{
			OutEvent.Strength = static_cast<float>(Event.strength_thousandths) / 1000.0f;
		}
		return true;
	}
	lipz_string Text;
	if (NextEvent == 0 && lipz_segment_event_string(Dialogue.Get(), &Segment, &Text) == LIPZ_OK && Text.length_bytes > 0)
	{
		NextEvent++;
		OutEvent = FLipzEvent();
		OutEvent.Character = Speaker;
		OutEvent.Text = LipzStrings::ToFString(Text);
		return true;
	}
	return false;
}

bool FLipzPlayback::FindClip(const FLipzDialogue& Dialogue, lipz_clip& OutClip) const
{
	return lipz_dialogue_clip(Dialogue.Get(), Cursor.clip_id, &OutClip) == LIPZ_OK;
}

bool FLipzPlayback::FindSegment(const FLipzDialogue& Dialogue, lipz_segment& OutSegment) const
{
	return lipz_cursor_segment(Dialogue.Get(), &Cursor, &OutSegment) == LIPZ_OK;
}

uint8 FLipzPlayback::GetViseme(const FLipzDialogue& Dialogue) const
{
	lipz_viseme Viseme = '-';
	lipz_cursor_viseme(Dialogue.Get(), &Cursor, &Viseme);
	return Viseme;
}

lipz_who FLipzPlayback::GetSpeaker() const
{
	return {{SpeakerUtf8.GetData(), static_cast<size_t>(SpeakerUtf8.Num())}, 1};
}
