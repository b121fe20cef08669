def look_after(event, context):
    return None
